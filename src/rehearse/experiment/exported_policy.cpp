#include "rehearse/experiment/exported_policy.hpp"

#include <algorithm>

namespace rehearse::experiment {
namespace {

constexpr Index kAnswers = 16;

/// States that were measured, spread evenly over the episode.
policy::Answers in_states_of(const Episode& episode, double dt_s) {
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

const Episode* an_episode(const History& history) {
  if (!history.episodes.empty()) return &history.episodes.back();
  return history.logs.empty() ? nullptr : &history.logs.front().episode;
}

policy::Exported exported_policy(const PastRun& run, std::optional<Index> trial) {
  const TrialRecord& record = run.trial(trial);
  if (record.trial > run.history.done()) return exported_policy(run.resolved, record, an_episode(run.history));
  const Episode& episode = run.history.episodes[static_cast<std::size_t>(record.trial - 1)];
  policy::Exported exported = exported_policy(run.resolved, record, &episode);
  exported.origin.total_reward = record.total_reward;
  return exported;
}

policy::Exported exported_policy(const Resolved& resolved, const TrialRecord& record, const Episode* like) {
  const scenario::Scenario& scenario = resolved.scenario;
  const Spec& spec = resolved.spec;
  const policy::Origin origin{.robot = spec.scenario,
                              .learner = spec.learner,
                              .prior = spec.prior,
                              .seed = spec.seed,
                              .trial = record.trial,
                              .total_reward = {}};
  const Episode start{.states = scenario.task.start_mean.transpose()};
  return policy::make_exported(origin, scenario.task, *policy_of(record, scenario), record.theta,
                               in_states_of(like ? *like : start, scenario.task.dt_s));
}

}  // namespace rehearse::experiment
