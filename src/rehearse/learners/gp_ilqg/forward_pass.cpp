#include "rehearse/learners/gp_ilqg/forward_pass.hpp"

#include <cmath>

#include "rehearse/core/episode.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::learners::gp_ilqg {

ForwardPass::ForwardPass(const lqr::Problem& problem, const lqr::StepCosts& costs, const lqr::Hold* hold)
    : problem_(problem), costs_(costs), hold_(hold), from_mean_start_(problem.task) {
  from_mean_start_.start_std.setZero();
}

std::vector<Trajectory> ForwardPass::follow(const std::vector<std::vector<policy::FeedbackStage>>& plans) const {
  const auto stages = static_cast<Index>(plans.front().size());
  const auto policy = policy::make_tracking(problem_.task, stages);
  Task planned = from_mean_start_;
  planned.horizon = std::min(stages - 1, planned.horizon);
  Matrix Theta(static_cast<Index>(plans.size()), policy->parameters());
  for (std::size_t i = 0; i < plans.size(); ++i)
    Theta.row(static_cast<Index>(i)) = policy::to_theta(plans[i]).transpose();
  rollout::Episodes episodes;
  rollout::simulate_episodes({problem_.model, *policy, planned, {}, {.sample = false, .measurement_noise = 0}}, Theta,
                             {}, episodes, problem_.evaluator);
  std::vector<Trajectory> all(plans.size());
  Episode episode;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const auto row = static_cast<Index>(i);
    episodes.copy(row, episode);
    Trajectory& trajectory = all[i];
    trajectory.steps = std::min(episode.steps(), stages - 1);
    trajectory.states = episode.states.topRows(trajectory.steps + 1);
    trajectory.actions = episode.actions.topRows(trajectory.steps);
    trajectory.promise = episodes.returns(row) + static_cast<double>(problem_.task.horizon - planned.horizon) *
                                                     (episode.steps() == planned.horizon && !episode.ended
                                                          ? episode.rewards(episode.steps() - 1)
                                                          : problem_.task.reward_floor);
    if (!episodes.failed[i] && trajectory.states.allFinite()) trajectory.cost = cost_of(trajectory, stages - 1);
  }
  return all;
}

Vector ForwardPass::beside_hold(const Trajectory& trajectory) const {
  const lqr::Columns& columns = costs_.columns();
  Vector beside(columns.planner_state());
  beside.head(columns.dx) =
      problem_.task.difference(trajectory.states.row(trajectory.steps).transpose(), hold_->stage.state);
  if (columns.before > 0)
    beside.tail(columns.before) = (trajectory.actions.row(trajectory.steps - 1).transpose() - hold_->stage.action)
                                      .cwiseQuotient(costs_.half_ranges());
  return beside;
}

double ForwardPass::cost_of(const Trajectory& trajectory, Index planned) const {
  if (trajectory.steps == 0) return kInf;
  Vector costs(trajectory.steps);
  costs_.evaluate(trajectory.rows(costs_.columns()), trajectory.times(problem_.task), costs);
  double sum = costs.sum();
  if (trajectory.steps < planned) return sum + static_cast<double>(planned - trajectory.steps) * costs_.of_floor();
  if (hold_) {
    const Vector beside = beside_hold(trajectory);
    sum += 0.5 * beside.dot(hold_->value.S * beside);
  }
  return sum;
}

}  // namespace rehearse::learners::gp_ilqg
