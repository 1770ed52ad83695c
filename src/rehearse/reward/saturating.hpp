#pragma once

#include <functional>

#include "rehearse/core/task.hpp"

namespace rehearse::reward {

/// Squared distances to the goal (one a row) of the states in X_next (rows × dx). Any thread.
using SquaredDistance = std::function<void(const ConstMatrixView& X_next, VectorView squared_distance)>;

/// exp(−d² / (2 width²)): 1 at the goal, 0 far away (Deisenroth 2015, eq. 44).
Reward saturating(SquaredDistance squared_distance, double width);

}  // namespace rehearse::reward
