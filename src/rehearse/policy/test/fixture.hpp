#pragma once
// States of each kind and two actions with awkward bounds.

#include <cmath>
#include <vector>

#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/policy/hand_over.hpp"

namespace rehearse::policy::fixture {

inline const std::vector<Interval> kBounds = {{-3.5, 3.5}, {0.1, 0.3}};
inline const Vector kScale{{10, 1, 2}};

inline Task task() {
  Task task;
  task.states = {{"v", ""}, {"angle", "", StateKind::angle}, {"place", "", StateKind::omitted}};
  task.actions = {{"a", "", kBounds[0]}, {"b", "", kBounds[1]}};
  task.start_mean = Vector{{0, 1, 5}};
  task.start_std = Vector::Zero(3);
  task.dt_s = 0.1;
  task.horizon = 10;
  return task;
}

inline FeatureMap features() { return task().feature_map(); }

/// Feedback about v = 1, angle = 3, whatever the place; it acts in a third of the states that are 3 times as far around
/// as a normal.
inline HandOver hand_over() {
  return {{Vector{{0.5, 0.2}}, Vector{{1, 3, 0}}, Matrix{{-1, 2, 0}, {0.01, -0.02, 0}}},
          Matrix{{0.08, 0.02, 0}, {0.02, 0.15, 0}, {0, 0, 0}}};
}

/// A row of the policy's inputs.
inline Vector inputs(const Matrix& X, Index row) {
  return Vector{{X(row, 0) / 10, std::cos(X(row, 1)), std::sin(X(row, 1)) / 2}};
}

inline Matrix normals(Index rows, Index columns, std::uint64_t seed) {
  Rng rng({.seed = seed});
  Matrix numbers(rows, columns);
  for (double& value : numbers.reshaped()) value = rng.normal();
  return numbers;
}

}  // namespace rehearse::policy::fixture
