#pragma once
// A slider on a line to be pulled to 0: state position, action a pull, parameters gain and drag. The smallest thing
// that can be learned; a whole run takes a fraction of a second.

#include <cmath>
#include <memory>
#include <string>

#include "rehearse/learners/black_drops/black_drops.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/system/ode.hpp"

namespace rehearse::learners::black_drops::slider {

inline void ode(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt(0) = phi(0) * u(0) - phi(1) * x(0);
}

inline const Vector kTruth{{1.5, 0.2}};
constexpr double kDt = 0.2;

/// exp(−position² / 0.08).
inline void reward(const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next, VectorView rewards) {
  for (Index i = 0; i < X_next.rows(); ++i) rewards(i) = std::exp(-X_next(i, 0) * X_next(i, 0) / 0.08);
}

inline Task task() {
  Task task;
  task.states = {{"position", "m"}};
  task.actions = {{"pull", "N", {-1, 1}}};
  task.start_mean = Vector{{1}};
  task.start_std = Vector{{0.02}};
  task.dt_s = kDt;
  task.horizon = 12;
  task.reward = reward;
  return task;
}

inline std::shared_ptr<const policy::Policy> policy() {
  return policy::make_linear(
      {.features = FeatureMap({StateKind::plain}), .scale = Vector::Ones(1), .squash = {{{-1, 1}}, 1}});
}

/// The right equation, starting from this gain; the drag is unknown too.
inline prior::Prior prior(double gain = 1) {
  const ParameterSpace space(
      {Parameter::continuous("gain", gain, {-2, 2}), Parameter::continuous("drag", 0.5, {0, 1})});
  return {"slider", system::make_ode_simulator(ode, space, kDt, 4), space};
}

inline Setting setting(std::optional<prior::Prior> prior = slider::prior(), std::uint64_t seed = 1) {
  Setting setting;
  setting.task = task();
  setting.policy = policy();
  setting.prior = std::move(prior);
  setting.seed = seed;
  return setting;
}

/// One trial on the true slider.
inline Episode run_trial(const Proposal& proposal, std::uint64_t trial) {
  const Task task = slider::task();
  const auto plant = system::make_ode_plant({.ode = ode,
                                             .phi = kTruth,
                                             .dt_s = kDt,
                                             .start_mean = task.start_mean,
                                             .start_std = task.start_std,
                                             .tolerance = 1e-9});
  return rollout::execute(*plant, *proposal.policy, proposal.theta, task,
                          Rng({.trial = trial, .purpose = Purpose::start_state}));
}

/// The learner of this name, with a small budget of rollouts.
inline std::unique_ptr<LearnerBuilder> builder(const std::string& name, const std::string& evaluations = "300") {
  for (auto& builder : builders()) {
    if (builder->name() != name) continue;
    const Fields fields = [&](FieldVisitor& v) { builder->fields(v); };
    for (const auto& [field, value] : {std::pair<std::string, std::string>{"search.race.max_evaluations", evaluations},
                                       {"search.race.descents", "4"},
                                       {"search.race.rounds", "2"},
                                       {"search.race.judgements", "4"},
                                       {"search.race.cmaes.population", "8"},
                                       {"search.finalists", "2"},
                                       {"search.selection", "10"}})
      if (!set_field(fields, field, value)) return nullptr;
    return std::move(builder);
  }
  return nullptr;
}

inline const char* const kNames[] = {"black-drops", "black-drops-prior", "gp-mi", "mi"};
inline const char* const kWithPrior[] = {"black-drops-prior", "gp-mi", "mi"};

}  // namespace rehearse::learners::black_drops::slider
