#include "rehearse/learners/black_drops/exploration.hpp"

#include "rehearse/policy/schedule.hpp"

namespace rehearse::learners::black_drops {

Vector random_actions(const Task& task, const FirstTrial& options, const StreamKey& key) {
  const bool extremes = options.kind == FirstTrial::Kind::extremes;
  return policy::random_schedule(task, extremes ? policy::RandomActions::extremes : policy::RandomActions::uniform,
                                 options.hold_s, key);
}

Vector smaller_actions(const Task& task, Vector schedule, double fraction) {
  if (fraction == 1) return schedule;
  for (Index a = 0; a < task.action_size(); ++a) {
    const Interval bounds = task.actions[static_cast<std::size_t>(a)].bounds;
    const double middle = (bounds.low + bounds.high) / 2;
    auto actions = schedule.segment(a * task.horizon, task.horizon).array();
    actions = middle + fraction * (actions - middle);
  }
  return schedule;
}

SearchResult safe_random_actions(const SearchProblem& problem, const Options& options, const StreamKey& trial) {
  constexpr double kLeast = 0.005, kNext = 0.7;  // fractions of the actions' ranges
  StreamKey actions = trial, judging = trial;
  actions.stage = Stage::episode;
  judging.stage = Stage::judging;
  const Vector whole = random_actions(problem.task, options.first_trial, actions);
  SearchResult judged{.excess = 1};
  Index rollouts = 0, failed = 0;
  for (double fraction = 1; fraction > kLeast && judged.excess > 0; fraction *= kNext) {
    judged = judge(problem, smaller_actions(problem.task, whole, fraction), options.search, judging);
    rollouts += judged.rollouts;
    failed += judged.failed_rollouts;
  }
  judged.rollouts = rollouts;
  judged.failed_rollouts = failed;
  return judged;
}

}  // namespace rehearse::learners::black_drops
