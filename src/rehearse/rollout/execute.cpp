#include "rehearse/rollout/execute.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace rehearse::rollout {
namespace {

Vector checked(Vector state, Index size, Index step) {
  if (state.size() != size || !state.allFinite())
    throw std::runtime_error(
        fmt::format("the plant's state at step {} has {} entries, must have {} finite ones", step, state.size(), size));
  return state;
}

void record_state(Episode& episode, Index row, const Vector& measured, const system::Plant& plant) {
  const Vector truth = plant.truth();
  episode.states.row(row) = measured.transpose();
  episode.true_states.row(row) = (truth.size() == measured.size() ? truth : measured).transpose();
}

double reward_of(const Task& task, const Episode& episode, Index t) {
  Vector reward(1);
  task.reward(episode.true_states.middleRows(t, 1), episode.actions.middleRows(t, 1),
              episode.true_states.middleRows(t + 1, 1), reward);
  return reward(0);
}

void truncate(Episode& episode, Index steps) {
  episode.states.conservativeResize(steps + 1, Eigen::NoChange);
  episode.true_states.conservativeResize(steps + 1, Eigen::NoChange);
  episode.actions.conservativeResize(steps, Eigen::NoChange);
  episode.rewards.conservativeResize(steps);
}

}  // namespace

Episode execute(system::Plant& plant, const policy::Policy& policy, const Vector& theta, const Task& task, Rng rng) {
  const Index T = task.horizon;
  Episode episode{.states = Matrix(T + 1, task.state_size()),
                  .true_states = Matrix(T + 1, task.state_size()),
                  .actions = Matrix(T, task.action_size()),
                  .rewards = Vector(T)};
  const Matrix Theta = theta.transpose();
  Matrix u(1, task.action_size());
  record_state(episode, 0, checked(plant.reset(rng), task.state_size(), 0), plant);
  for (Index t = 0; t < T; ++t) {
    policy.act(Theta, episode.states.middleRows(t, 1), static_cast<double>(t) * task.dt_s, u);
    episode.actions.row(t) = u;
    record_state(episode, t + 1, checked(plant.step(u.transpose()), task.state_size(), t + 1), plant);
    episode.rewards(t) = reward_of(task, episode, t);
    if (task.ended && task.ended(episode.true_states.row(t + 1).transpose())) {
      episode.ended = true;
      episode.charged = static_cast<double>(T - t - 1) * task.reward_floor;
      truncate(episode, t + 1);
      break;
    }
  }
  return episode;
}

}  // namespace rehearse::rollout
