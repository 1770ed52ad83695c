#include "rehearse/rollout/execute.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "rehearse/core/episode_fit.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/rollout/episodes.hpp"
#include "rehearse/rollout/simulation.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::rollout {
namespace {

/// True if a state is within what a robot may answer.
bool is_plausible(const Vector& state) { return (state.array().abs() <= kLargestGiven).all(); }

/// what: "state", or "true state".
Vector checked(Vector state, const Task& task, Index step, const char* what = "state") {
  if (state.size() != task.state_size())
    throw std::runtime_error(fmt::format("the plant's {} at step {} has {} entries, must have {}", what, step,
                                         state.size(), task.state_size()));
  for (Index i = 0; i < state.size(); ++i) {
    if (std::abs(state(i)) <= kLargestGiven) continue;
    const std::string bound = std::isfinite(state(i)) ? fmt::format("within ±{:g}", kLargestGiven) : "finite";
    throw std::runtime_error(fmt::format("the plant's {} at step {} has {} = {}, must be {}", what, step,
                                         task.states[static_cast<std::size_t>(i)].name, state(i), bound));
  }
  return state;
}

/// The reason why actions must not reach the plant; empty: they may. Rounding is allowed.
std::string unfit(const Matrix& u, const Task& task, Index step) {
  if (!u.allFinite()) return fmt::format("an action at step {} is not finite", step);
  for (Index i = 0; i < u.cols(); ++i) {
    const ActionVariable& action = task.actions[static_cast<std::size_t>(i)];
    const auto [low, high] = action.bounds;
    const double rounding = 1e-9 * (high - low);
    if (u(0, i) < low - rounding || u(0, i) > high + rounding)
      return fmt::format("the policy's action {} at step {} is {:g}, must be in {:g} to {:g}", action.name, step,
                         u(0, i), low, high);
  }
  return {};
}

void record_state(Episode& episode, Index row, const Vector& measured, const system::Plant& plant, const Task& task) {
  const Vector truth = plant.truth();
  episode.states.row(row) = measured.transpose();
  const bool known = truth.size() == measured.size();
  episode.true_states.row(row) = (known ? checked(truth, task, row, "true state") : measured).transpose();
}

/// Calls work(steps) with step t of an episode.
void with_step(const Task& task, const Episode& episode, Index t, const std::function<void(const Steps&)>& work) {
  const Matrix none = Matrix::Zero(1, episode.actions.cols());
  work({episode.true_states.middleRows(t, 1), episode.actions.middleRows(t, 1),
        episode.true_states.middleRows(t + 1, 1), t > 0 ? episode.actions.middleRows(t - 1, 1) : none.middleRows(0, 1),
        static_cast<double>(t) * task.dt_s});
}

/// The step's reward, less its cost.
double reward_of(const Task& task, const Episode& episode, Index t) {
  Vector reward(1), cost = Vector::Zero(1);
  with_step(task, episode, t, [&](const Steps& step) {
    task.reward(step.X, step.U, step.X_next, reward);
    if (task.cost) task.cost(step, cost);
  });
  return reward(0) - cost(0);
}

/// Ends an episode after `steps`: the rest earns the reward floor. failure: why, if that is no fall.
void end(Episode& episode, Index steps, const Task& task, std::string failure = "") {
  episode.ended = true;
  episode.failure = std::move(failure);
  episode.charged = static_cast<double>(task.horizon - steps) * task.reward_floor;
  episode.states.conservativeResize(steps + 1, Eigen::NoChange);
  episode.true_states.conservativeResize(steps + 1, Eigen::NoChange);
  episode.actions.conservativeResize(steps, Eigen::NoChange);
  episode.rewards.conservativeResize(steps);
}

/// The reward of the step to state t+1. False: it is not finite, and that step earns the reward floor.
bool earn(Episode& episode, Index t, const Task& task) {
  const double reward = reward_of(task, episode, t);
  episode.rewards(t) = std::isfinite(reward) ? reward : task.reward_floor;
  return std::isfinite(reward);
}

/// The reward of the whole episode, after its last step.
void earn_at_end(Episode& episode, const Task& task) {
  if (!task.episode_reward) return;
  episode.episode_reward = task.episode_reward(episode);
  if (std::isfinite(episode.episode_reward)) return;
  end(episode, episode.steps(), task, "the reward of the whole episode is not finite");
  episode.episode_reward = task.reward_floor;
}

/// The reward of the step to state t+1, and whether the episode ends there.
bool ends_at(Episode& episode, Index t, const Task& task) {
  if (!earn(episode, t, task)) {
    end(episode, t + 1, task, fmt::format("the reward at step {} is not finite", t + 1));
    return true;
  }
  episode.broken_limits = limits_broken_by(task, episode, t);
  const bool fell = task.ended && holds(task.ended, episode.true_states.row(t + 1).transpose());
  if (episode.broken_limits.empty() && !fell) return false;
  end(episode, t + 1, task);
  return true;
}

/// contained: a state that is not finite is a fall, and the plant's fault otherwise.
Episode run(system::Plant& plant, const policy::Policy& policy, const Vector& theta, const Task& task, Rng& rng,
            const std::function<void()>& before_step, bool contained) {
  Violations violations;
  violations.add(misfits(policy, theta.size(), task));
  violations.throw_if_any();
  const Index T = task.horizon;
  Episode episode{.states = Matrix(T + 1, task.state_size()),
                  .true_states = Matrix(T + 1, task.state_size()),
                  .actions = Matrix(T, task.action_size()),
                  .rewards = Vector(T)};
  const Matrix Theta = theta.transpose();
  Matrix u(1, task.action_size());
  const Actuators actuators = task.actuators();
  const system::EpisodeOn on_plant(plant);
  record_state(episode, 0, checked(plant.reset(rng), task, 0), plant, task);
  for (Index t = 0; t < T; ++t) {
    if (before_step) before_step();
    policy.act(Theta, episode.states.middleRows(t, 1), static_cast<double>(t) * task.dt_s, u);
    actuators.command(episode.states.middleRows(t, 1), u);
    if (std::string why = unfit(u, task, t); !why.empty()) {
      end(episode, t, task, std::move(why));
      break;
    }
    episode.actions.row(t) = u;
    const Vector next = plant.step(u.transpose());
    if (contained && !is_plausible(next)) {
      const std::string why = next.allFinite() ? fmt::format("beyond ±{:g}", kLargestGiven) : "not finite";
      end(episode, t, task, fmt::format("the state at step {} is {}", t + 1, why));
      break;
    }
    record_state(episode, t + 1, checked(next, task, t + 1), plant, task);
    if (ends_at(episode, t, task)) break;
    if (plant.ended()) {
      end(episode, t + 1, task);
      break;
    }
  }
  earn_at_end(episode, task);
  return episode;
}

}  // namespace

Episode execute(system::Plant& plant, const policy::Policy& policy, const Vector& theta, const Task& task, Rng rng,
                const std::function<void()>& before_step) {
  return run(plant, policy, theta, task, rng, before_step, false);
}

Episode execute(const SimulatedRobot& robot, const policy::Policy& policy, const Vector& theta, const Task& task,
                Rng rng, const std::function<void()>& before_step) {
  const auto plant = system::make_simulated_plant(robot.simulator, robot.phi,
                                                  {task.start_mean, task.start_std, robot.measurement_std});
  return run(*plant, policy, theta, task, rng, before_step, true);
}

Episode judged(Episode episode, const Task& task) {
  if (episode.true_states.size() == 0) episode.true_states = episode.states;
  episode.rewards.setZero(episode.steps());
  require_fit(episode, task);
  for (Index t = 0, steps = episode.steps(); t < steps; ++t)
    if (ends_at(episode, t, task)) break;
  earn_at_end(episode, task);
  return episode;
}

void fail(Episode& episode, const Task& task, const std::string& why) { end(episode, episode.steps(), task, why); }

std::vector<std::string> limits_broken_by(const Task& task, const Episode& episode, Index t) {
  std::vector<std::string> broken;
  Vector kept(1);
  with_step(task, episode, t, [&](const Steps& step) {
    for (const Limit& limit : task.limits) {
      limit.holds(step, kept);
      if (!is_true(kept(0))) broken.push_back(limit.name);
    }
  });
  return broken;
}

Episode as_measured(Episode episode, const Task& task) {
  episode.true_states = episode.states;
  episode.rewards.setZero(episode.steps());
  require_fit(episode, task);
  for (Index t = 0; t < episode.steps(); ++t) earn(episode, t, task);
  if (task.episode_reward) episode.episode_reward = episode_reward_of(task, episode);
  return episode;
}

}  // namespace rehearse::rollout
