#pragma once
// A learner whose model can fail, as one that is a program of somebody.

#include <memory>
#include <utility>
#include <vector>

#include "fake.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::experiment::fake {

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

/// The pretending learner with such a model.
class FragileLearner final : public learners::Learner {
 public:
  FragileLearner(std::unique_ptr<learners::Learner> echo, const bool* broken)
      : echo_(std::move(echo)), broken_(broken) {}
  const learners::Proposal& ask() override {
    proposal_ = echo_->ask();
    proposal_.model = std::make_shared<FragileModel>(proposal_.model, broken_);
    return proposal_;
  }
  void tell(const Episode& episode) override { echo_->tell(episode); }
  nlohmann::json save() const override { return echo_->save(); }
  std::vector<learners::Table> tables() override { return echo_->tables(); }
  void load(const std::vector<Episode>& episodes, const nlohmann::json& state) override {
    echo_->load(episodes, state);
  }

 private:
  std::unique_ptr<learners::Learner> echo_;
  const bool* broken_;
  learners::Proposal proposal_;
};

inline Catalogue fragile(const bool& broken) {
  class Builder final : public EchoBuilder {
   public:
    explicit Builder(const bool* broken) : EchoBuilder(true, {}), broken_(broken) {}
    std::unique_ptr<learners::Learner> build(learners::Setting setting) const override {
      return std::make_unique<FragileLearner>(EchoBuilder::build(std::move(setting)), broken_);
    }

   private:
    const bool* broken_;
  };
  Catalogue all = catalogue();
  all.learner_families = {[&broken] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<Builder>(&broken));
    return family;
  }};
  return all;
}

}  // namespace rehearse::experiment::fake
