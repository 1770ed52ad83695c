#include "rehearse/experiment/exported_policy.hpp"

#include <algorithm>

namespace rehearse::experiment {
namespace {

constexpr Index kAnswers = 16;

/// States that were measured, spread evenly over the episode.
policy::Answers asked(const Episode& episode, double dt_s) {
  const Index states = episode.states.rows(), count = std::min(kAnswers, states);
  policy::Answers asked{.states = Matrix(count, episode.states.cols()), .times_s = Vector(count), .actions = {}};
  for (Index i = 0; i < count; ++i) {
    const Index t = count > 1 ? i * (states - 1) / (count - 1) : 0;
    asked.states.row(i) = episode.states.row(t);
    asked.times_s(i) = static_cast<double>(t) * dt_s;
  }
  return asked;
}

}  // namespace

policy::Exported exported_policy(const PastRun& run, std::optional<Index> trial) {
  const TrialRecord& record = run.trial(trial);
  const scenario::Scenario& scenario = run.resolved.scenario;
  const Spec& spec = run.resolved.spec;
  const policy::Origin origin{.robot = spec.scenario,
                              .learner = spec.learner,
                              .prior = spec.prior,
                              .seed = spec.seed,
                              .trial = record.trial,
                              .total_reward = record.total_reward};
  const Episode& episode = run.history.episodes[static_cast<std::size_t>(record.trial - 1)];
  return policy::make_exported(origin, scenario.task, *policy_of(record, scenario), record.theta,
                               asked(episode, scenario.task.dt_s));
}

}  // namespace rehearse::experiment
