#pragma once
// The pretending learner behind another one, which passes all on but what a test is about.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "fake.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::experiment::fake {

class Wrapped : public learners::Learner {
 public:
  explicit Wrapped(std::unique_ptr<learners::Learner> inner) : inner_(std::move(inner)) {}
  const learners::Proposal& ask() override { return inner_->ask(); }
  void tell(const Episode& episode) override { inner_->tell(episode); }
  nlohmann::json save() const override { return inner_->save(); }
  std::vector<learners::Table> tables() override { return inner_->tables(); }
  void load(const std::vector<Episode>& episodes, const nlohmann::json& state) override {
    inner_->load(episodes, state);
  }

 private:
  std::unique_ptr<learners::Learner> inner_;
};

using Wrap = std::function<std::unique_ptr<learners::Learner>(std::unique_ptr<learners::Learner>)>;

/// The catalogue whose one learner, "echo", is what `wrap` makes of the pretending one.
inline Catalogue catalogue_of(Wrap wrap) {
  class Builder final : public EchoBuilder {
   public:
    explicit Builder(Wrap wrap) : EchoBuilder(true, {}), wrap_(std::move(wrap)) {}
    std::unique_ptr<learners::Learner> build(learners::Setting setting) const override {
      return wrap_(EchoBuilder::build(std::move(setting)));
    }

   private:
    Wrap wrap_;
  };
  Catalogue all = catalogue();
  all.learner_families = {[wrap = std::move(wrap)] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<Builder>(wrap));
    return family;
  }};
  return all;
}

/// Predicts nothing while it is broken, as a simulator whose program is gone.
class FragileModel final : public dynamics::DynamicsModel {
 public:
  FragileModel(std::shared_ptr<const DynamicsModel> model, const bool* broken)
      : model_(std::move(model)), broken_(broken) {}
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean, MatrixView var) const override {
    if (*broken_) throw system::Unavailable("its program is gone");
    model_->predict(X, U, mean, var);
  }

 private:
  std::shared_ptr<const DynamicsModel> model_;
  const bool* broken_;
};

/// The learner with such a model.
class FragileLearner final : public Wrapped {
 public:
  FragileLearner(std::unique_ptr<learners::Learner> inner, const bool* broken)
      : Wrapped(std::move(inner)), broken_(broken) {}
  const learners::Proposal& ask() override {
    proposal_ = Wrapped::ask();
    proposal_.model = std::make_shared<FragileModel>(proposal_.model, broken_);
    return proposal_;
  }

 private:
  const bool* broken_;
  learners::Proposal proposal_;
};

inline Catalogue fragile(const bool& broken) {
  return catalogue_of([&broken](auto inner) { return std::make_unique<FragileLearner>(std::move(inner), &broken); });
}

}  // namespace rehearse::experiment::fake
