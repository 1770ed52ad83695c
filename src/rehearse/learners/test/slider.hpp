#pragma once
// A slider on a line to be pulled to 0: state position, action a pull, parameters gain and drag. The smallest thing
// that can be learned; a whole run takes a fraction of a second. For the tests of all learners.

#include <cmath>
#include <cstdint>
#include <vector>

#include "rehearse/learners/learner.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/system/ode.hpp"
#include "rehearse/system/plain_kernel.hpp"

namespace rehearse::learners::slider {

inline void ode(const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
  dxdt(0) = phi(0) * u(0) - phi(1) * x(0);
}

inline const Vector kTruth{{1.5, 0.2}};

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
  task.dt_s = 0.2;
  task.horizon = 12;
  task.reward = reward;
  return task;
}

inline prior::Prior prior_in(const ParameterSpace& space) {
  return {"slider", system::make_ode_simulator(ode, space, task().dt_s, 4), space};
}

/// The right equation, starting from this gain; the drag is unknown too.
inline prior::Prior prior(double gain = 1) {
  return prior_in(
      ParameterSpace({Parameter::continuous("gain", gain, {-2, 2}), Parameter::continuous("drag", 0.5, {0, 1})}));
}

/// One trial on the slider of these parameters.
inline Episode run_trial_on(const Vector& truth, const Proposal& proposal, std::uint64_t trial) {
  const Task task = slider::task();
  const auto plant = system::make_ode_plant({.ode = ode,
                                             .phi = truth,
                                             .dt_s = task.dt_s,
                                             .around = {task.start_mean, task.start_std, {}},
                                             .tolerance = 1e-9});
  return rollout::execute(*plant, *proposal.policy, proposal.theta, task,
                          Rng({.trial = trial, .purpose = Purpose::start_state}));
}

inline Episode run_trial(const Proposal& proposal, std::uint64_t trial) {
  return run_trial_on(kTruth, proposal, trial);
}

struct History {
  std::vector<Proposal> proposals;
  std::vector<double> returns;
};
inline History learn(Learner& learner, std::uint64_t trials,
                     Episode (*run_trial)(const Proposal&, std::uint64_t) = slider::run_trial) {
  History history;
  for (std::uint64_t trial = 1; trial <= trials; ++trial) {
    history.proposals.push_back(learner.ask());
    const Episode episode = run_trial(history.proposals.back(), trial);
    history.returns.push_back(episode.total_reward());
    learner.tell(episode);
  }
  return history;
}

}  // namespace rehearse::learners::slider
