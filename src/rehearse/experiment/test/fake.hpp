#pragma once
// A robot on a line and a learner that only pretends: whole runs in milliseconds, without the other rooms.

#include <cmath>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::experiment::fake {

using rehearse::message_of, rehearse::test_folder;

inline ParameterSpace line_parameters(double gain) {
  return ParameterSpace(
      {{.name = "gain", .unit = "1", .value = gain, .kind = Parameter::Kind::continuous, .box = {0.1, 4}},
       {.name = "drift", .unit = "m/s", .value = 0}});
}

/// x' = x + dt (gain u + drift)
class LineSimulator final : public system::Simulator {
 public:
  const ParameterSpace& parameters() const override { return parameters_; }
  void change(const ConstMatrixView&, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    dX = (0.1 * (phi(0) * U.array() + phi(1))).matrix();
  }

 private:
  ParameterSpace parameters_ = line_parameters(1);
};

/// The same with gain 1, measurement noise and, unless that is 0, a random start; fails in the trials it is told to.
class LinePlant final : public system::Plant {
 public:
  LinePlant(double gain, double noise, bool breaks) : gain_(gain), noise_(noise), breaks_(breaks) {}
  Vector reset(Rng& rng) override {
    x_ = 1 + (noise_ > 0 ? 0.1 : 0) * rng.normal();
    rng_ = rng;
    return measured();
  }
  Vector step(const Vector& u) override {
    if (breaks_ && x_ < 0.5) throw std::runtime_error("the wheel came off");
    x_ += 0.1 * gain_ * u(0);
    return measured();
  }
  Vector truth() const override { return Vector::Constant(1, x_); }

 private:
  Vector measured() { return Vector::Constant(1, x_ + noise_ * rng_.normal()); }
  double gain_, noise_, x_ = 0;
  bool breaks_;
  Rng rng_{StreamKey{}};
};

/// u = clamp(θ0 x + θ1)
class LinePolicy final : public policy::Policy {
 public:
  std::string name() const override { return "line"; }
  Index parameters() const override { return 2; }
  Index actions() const override { return 1; }
  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double, MatrixView U) const override {
    U = (Theta.col(0).array() * X.col(0).array() + Theta.col(1).array()).max(-1).min(1).matrix();
  }
};

inline Task line_task() {
  return {.states = {{.name = "x", .unit = "m"}},
          .actions = {{.name = "v", .unit = "m/s", .bounds = {-1, 1}}},
          .start_mean = Vector::Constant(1, 1.0),
          .start_std = Vector::Constant(1, 0.1),
          .dt_s = 0.1,
          .horizon = 12,
          .reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next,
                       VectorView rewards) { rewards = (-next.col(0).array().square()).exp().matrix(); },
          .solved = [](const Episode& e) { return std::abs(e.true_states(e.steps(), 0)) < 0.1; }};
}

using MakePlant = std::function<std::unique_ptr<system::Plant>()>;

class LineBuilder : public scenario::ScenarioBuilder {
 public:
  /// `wrap`: what becomes of the way in which plants are made.
  explicit LineBuilder(std::function<MakePlant(MakePlant)> wrap = {}) : wrap_(std::move(wrap)) {}
  std::string name() const override { return "line"; }
  std::string summary() const override { return "a cart on a line goes to zero"; }
  std::vector<std::string> prior_names() const override { return {"near", "far"}; }
  void fields(FieldVisitor& v) override {
    v.number("plant.gain", gain_, "of the cart [1/s]", above(0));
    v.number("noise", noise_, "standard deviation of the measurement noise [m]", at_least(0));
    v.boolean("breaks", breaks_, "the cart breaks");
    v.integer("evaluations", evaluations_, "extra episodes of a trial", at_least(0));
  }
  scenario::Scenario build() const override {
    const auto simulator = std::make_shared<LineSimulator>();
    const MakePlant make_plant = [*this] { return std::make_unique<LinePlant>(gain_, noise_, breaks_); };
    return {.name = "line",
            .task = line_task(),
            .make_plant = wrap_ ? wrap_(make_plant) : make_plant,
            .priors = {{"near", simulator, line_parameters(1.2)}, {"far", simulator, line_parameters(3)}},
            .oracle = simulator,
            .policy = std::make_shared<LinePolicy>(),
            .evaluations = evaluations_};
  }

 private:
  double gain_ = 1, noise_ = 0.01;
  bool breaks_ = false;
  Index evaluations_ = 0;
  std::function<MakePlant(MakePlant)> wrap_;
};

/// Predicts with the simulator's gain.
class LineModel final : public dynamics::DynamicsModel {
 public:
  explicit LineModel(double gain) : gain_(gain) {}
  void predict(const ConstMatrixView&, const ConstMatrixView& U, MatrixView mean, MatrixView variance) const override {
    mean = 0.1 * gain_ * U;
    variance.setConstant(1e-4);
  }

 private:
  double gain_;
};

/// The call at which a pretending learner kills its own process, for tests of what is left of its run.
struct Killer {
  enum class Place { nowhere, ask, tell, save } place = Place::nowhere;
  Index call = 0;
  void pass(Place here, Index count) const {
    if (here == place && count == call) std::raise(SIGKILL);
  }
};

inline constexpr double kUnknown = kNaN;

/// Its next policy depends on everything that it has seen and proposed, by way of what it saves.
class EchoLearner final : public learners::Learner {
 public:
  EchoLearner(learners::Setting setting, double step, Killer killer)
      : setting_(std::move(setting)), step_(step), killer_(killer) {}

  const learners::Proposal& ask() override {
    killer_.pass(Killer::Place::ask, told_);
    if (setting_.progress) setting_.progress({.phase = "search", .done = 0.5, .best = memory_, .rollouts = 10});
    proposal_.policy = setting_.policy;
    proposal_.theta = Vector::Zero(2);
    proposal_.theta << -step_ * static_cast<double>(told_ + 1), std::sin(memory_ + static_cast<double>(setting_.seed));
    proposal_.rollouts = 100 + told_;
    if (!setting_.prior && told_ == 0) propose_schedule();
    if (setting_.prior) propose_with_prior();
    asked_ = true;
    return proposal_;
  }
  void tell(const Episode& episode) override {
    killer_.pass(Killer::Place::tell, told_);
    if (!asked_) throw std::logic_error("told before it was asked");
    ++told_;
    memory_ = 0.3 * memory_ + episode.states.sum() + proposal_.theta(1);
    asked_ = false;
  }
  std::vector<learners::Table> tables() override {
    return {{"memories", {"told", "memory [m]"}, Matrix{{static_cast<double>(told_), memory_}, {0, kUnknown}}}};
  }
  nlohmann::json save() const override {
    killer_.pass(Killer::Place::save, told_);
    return {{"memory", memory_}, {"evidence", -kInf}};
  }
  void load(const std::vector<Episode>& episodes, const nlohmann::json& state) override {
    told_ = static_cast<Index>(episodes.size());
    memory_ = state.at("memory").get<double>();
    if (!std::isinf(state.at("evidence").get<double>())) throw std::logic_error("infinity was lost");
  }

 private:
  /// Like the first trial of learners without a prior.
  void propose_schedule() {
    const Task& task = setting_.task;
    proposal_.policy = policy::make_schedule(task.action_bounds(), task.dt_s, task.horizon);
    proposal_.theta = Vector::LinSpaced(task.horizon, -1, 0.5);
  }
  void propose_with_prior() {
    proposal_.phi = setting_.prior->space.values();
    (*proposal_.phi)(0) += 0.01 * memory_;
    proposal_.predicted_return = memory_ / 3;
    if (told_ > 0) proposal_.log_evidence = -memory_;
    if (told_ > 0)
      proposal_.posterior = {{setting_.prior->space[0]}, proposal_.phi->head(1), Matrix::Constant(1, 1, 9)};
    proposal_.model = std::make_shared<LineModel>((*proposal_.phi)(0));
    if (told_ == 2) proposal_.moments = [&] { return ExpectedEpisode::unknown(setting_.task.horizon, 1); };
    proposal_.notes = {"a note, with a comma"};
    proposal_.left_out_rows = told_;
  }

  learners::Setting setting_;
  double step_;
  Killer killer_;
  Index told_ = 0;
  double memory_ = 0;
  bool asked_ = false;
  learners::Proposal proposal_;
};

class EchoBuilder : public learners::LearnerBuilder {
 public:
  EchoBuilder(bool takes_prior, Killer killer) : takes_prior_(takes_prior), killer_(killer) {}
  std::string name() const override { return takes_prior_ ? "echo" : "echo-alone"; }
  std::string summary() const override { return "pretends to learn"; }
  learners::PriorUse prior_use() const override {
    return takes_prior_ ? learners::PriorUse::required : learners::PriorUse::none;
  }
  bool chooses_priors() const override { return takes_prior_; }
  void fields(FieldVisitor& v) override {
    v.number("search.step", step_, expert("of the search # of policies"), above(0));
  }
  std::unique_ptr<learners::Learner> build(learners::Setting setting) const override {
    return std::make_unique<EchoLearner>(std::move(setting), step_, killer_);
  }

 private:
  bool takes_prior_;
  Killer killer_;
  double step_ = 0.4;
};

inline Catalogue catalogue(Killer killer = {}) {
  Catalogue catalogue;
  catalogue.scenarios = {{"line", [] { return std::make_unique<LineBuilder>(); }}};
  catalogue.learner_families = {[killer] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<EchoBuilder>(true, killer));
    family.push_back(std::make_unique<EchoBuilder>(false, killer));
    return family;
  }};
  catalogue.not_built = {{"hexapod", "DART 6.12 was not found"}, {"pilco", "not written yet"}};
  return catalogue;
}

/// The same, with another way to make the plant of each run.
inline Catalogue catalogue_with(const std::function<MakePlant(MakePlant)>& wrap) {
  Catalogue wrapped = catalogue();
  wrapped.scenarios = {{"line", [wrap] { return std::make_unique<LineBuilder>(wrap); }}};
  return wrapped;
}

}  // namespace rehearse::experiment::fake
