#include "rehearse/experiment/exported_policy.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/policy/description.hpp"

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

/// Adds a state in which the feedback near a goal acts: an episode need not have come to one.
void add_near(const policy::Near& near, policy::Answers& asked) {
  const Index rows = asked.states.rows(), dx = near.state.size();
  Vector state = near.state;
  for (Index i = 0; i < dx; ++i)
    if (near.shape(i, i) > 0) state(i) += 0.5 / (static_cast<double>(dx) * std::sqrt(near.shape(i, i)));
  asked.states.conservativeResize(rows + 1, Eigen::NoChange);
  asked.states.row(rows) = state.transpose();
  asked.times_s.conservativeResize(rows + 1);
  asked.times_s(rows) = asked.times_s(rows - 1);
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
  const auto policy = policy_of(record, scenario);
  policy::Answers asked = in_states_of(like ? *like : start, scenario.task.dt_s);
  if (const auto near = policy::describe(*policy, record.theta).near) add_near(*near, asked);
  return policy::make_exported(origin, scenario.task, *policy, record.theta, asked);
}

}  // namespace rehearse::experiment
