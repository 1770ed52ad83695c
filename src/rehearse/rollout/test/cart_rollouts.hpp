#pragma once
// Rollouts of the cart, and the random numbers that each of them meets.

#include <cstdint>

#include "cart.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::rollout::cart {

inline constexpr StreamKey kKey{.seed = 3, .trial = 2, .purpose = Purpose::simulated_noise};
inline constexpr SimulateOptions kUnclipped{.noise_clip = 0};

inline Simulated simulate_cart(const Task& task, const Matrix& Theta, Index particles,
                               const SimulateOptions& options = {}, const dynamics::DynamicsModel& model = Model(),
                               std::uint64_t first = 0, const Evaluator& evaluator = serial_evaluator()) {
  return simulate({model, *policy(), task, kKey, options}, Theta, {first, particles}, evaluator);
}

/// The numbers that rollout (candidate, particle) meets, from their definition.
struct Noise {
  Matrix start, steps;  // 1 × 2, T × 2
};
inline Noise noise_of(const Task& task, std::uint64_t candidate, std::uint64_t particle) {
  Noise noise{Matrix(1, 2), Matrix(task.horizon, 2)};
  StreamKey start = kKey;
  start.purpose = Purpose::simulated_start;
  fill_normals(start, &candidate, &particle, 0, noise.start);
  Matrix row(1, 2);
  for (Index t = 0; t < task.horizon; ++t) {
    fill_normals(kKey, &candidate, &particle, static_cast<std::uint64_t>(t), row);
    noise.steps.row(t) = row;
  }
  return noise;
}

inline Vector start_of(const Task& task, const Noise& noise) {
  return task.start_mean + (task.start_std.array() * noise.start.row(0).transpose().array()).matrix();
}

}  // namespace rehearse::rollout::cart
