#pragma once
// A slider on a line to be pulled to 0: the smallest thing that can be learned.

#include "rehearse/learners/pilco/pilco.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/system/ode.hpp"

namespace rehearse::learners::pilco::slider {

/// φ: the strength of the pull, the slider's own way back.
inline void ode(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt(0) = phi(0) * u(0) - phi(1) * x(0);
}

inline Task task() {
  Task task;
  task.states = {{"position", "m"}};
  task.actions = {{"pull", "N", {-1, 1}}};
  task.start_mean = Vector{{1}};
  task.start_std = Vector{{0.02}};
  task.dt_s = 0.2;
  task.horizon = 12;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next, VectorView rewards) {
    rewards = (-X_next.col(0).array().square() / 0.08).exp();
  };
  task.saturating_reward = SaturatingReward{Vector::Zero(1), Matrix::Constant(1, 1, 1 / 0.2)};
  return task;
}

inline std::shared_ptr<const policy::Policy> rbf() {
  return policy::make_rbf(
      {.features = task().feature_map(), .scale = Vector::Constant(1, 2), .centres = 5, .bounds = {{-1, 1}}});
}

inline Setting setting(std::uint64_t seed = 1) {
  Setting setting;
  setting.task = task();
  setting.policy = rbf();
  setting.seed = seed;
  return setting;
}

/// The slider with other φ.
inline prior::Prior prior(double strength, double way_back) {
  const ParameterSpace space({{.name = "strength", .unit = "m/(N s)", .value = strength},
                              {.name = "way_back", .unit = "1/s", .value = way_back}});
  return {"slider", system::make_ode_simulator(ode, space, task().dt_s, 4), space};
}

inline Episode run_trial(const Proposal& proposal, std::uint64_t trial) {
  const Task task = slider::task();
  const auto plant = system::make_ode_plant({.ode = ode,
                                             .phi = Vector{{1.5, 0.2}},
                                             .dt_s = task.dt_s,
                                             .start_mean = task.start_mean,
                                             .start_std = task.start_std,
                                             .tolerance = 1e-9});
  return rollout::execute(*plant, *proposal.policy, proposal.theta, task,
                          Rng({.trial = trial, .purpose = Purpose::start_state}));
}

inline std::vector<Proposal> learn(Learner& learner, std::uint64_t trials, std::vector<double>* returns = nullptr) {
  std::vector<Proposal> proposals;
  for (std::uint64_t trial = 1; trial <= trials; ++trial) {
    proposals.push_back(learner.ask());
    const Episode episode = run_trial(proposals.back(), trial);
    if (returns) returns->push_back(episode.total_reward());
    learner.tell(episode);
  }
  return proposals;
}

}  // namespace rehearse::learners::pilco::slider
