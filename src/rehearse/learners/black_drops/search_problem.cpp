#include "rehearse/learners/black_drops/search_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rehearse/statistics/intervals.hpp"

namespace rehearse::learners::black_drops {
namespace {

/// Rollouts of a policy that show that it keeps every limit, if none of them breaks one.
Index rollouts_that_show_safety(const Task& task, const SearchOptions& options) {
  Index most = 1;
  for (const Limit& limit : task.limits) most = std::max(most, statistics::runs_to_exclude(limit.risk));
  return (most + options.particles - 1) / options.particles;
}

}  // namespace

void SearchOptions::fields(FieldVisitor& v) {
  v.choice("method", method,
           "CMA-ES with competing runs (race) or restarts; gradient ascent; polish: race, then gradient ascent",
           {"race", "restarts", "gradient", "polish"}, published("restarts"));
  v.number("box", box, "policy parameters are searched in [−box, box], unless the policy has bounds of its own",
           between(1e-6, 1e6));
  v.integer("particles", particles, expert("rollouts of one evaluation"), between(1, 1e6));
  v.number("extra_s", extra_s, "simulated episodes are longer than a trial by this, so that policies hold longer [s]",
           between(0, 1e4));
  v.boolean("hand_over", hand_over, "policies hand over to linear feedback (LQR) near a goal where the robot can stay");
  v.group("simulate", simulate);
  v.group("race", race);
  v.group("restarts", restarts, kExpert);
  v.group("gradient", gradient);
  v.integer("finalists", finalists, "number of best policies that are compared once more at the end", between(1, 1e6),
            published(1));
  v.integer("selection", selection, "rollouts of each finalist; their mean is the predicted return", between(1, 1e6),
            published(1));
  v.group("safety", safety);
}

SearchProblem with_task(const SearchProblem& problem, const Task& task) {
  return {problem.model, problem.policy, task, problem.evaluator, problem.progress, problem.doubted};
}

Task continued(Task task, double extra_s) {
  const Index T = task.horizon;
  task.horizon += static_cast<Index>(std::llround(extra_s / task.dt_s));
  if (task.horizon > T && task.solved)
    task.solved = [solved = std::move(task.solved), T](const Episode& episode) {
      return !episode.ended && episode.steps() > T && solved(episode.part(0, T)) &&
             solved(episode.part(episode.steps() - T, T));
    };
  return task;
}

Index comparisons(const SearchProblem& problem, const SearchOptions& options) {
  if (!problem.task.limits.empty())
    return std::max({options.selection, options.safety.rollouts, rollouts_that_show_safety(problem.task, options)});
  const bool sure = !options.simulate.sample || problem.model.certain();
  const bool exact = options.simulate.measurement_noise == 0 || problem.model.measurement_std().isZero(0);
  return sure && exact && problem.task.start_std.isZero(0) ? 1 : options.selection;
}

}  // namespace rehearse::learners::black_drops
