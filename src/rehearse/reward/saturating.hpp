#pragma once

#include <functional>
#include <optional>

#include "rehearse/core/task.hpp"

namespace rehearse::reward {

/// Squared distances to the goal (one a row) of the states in X_next (rows × dx). Any thread.
using SquaredDistance = std::function<void(const ConstMatrixView& X_next, VectorView squared_distance)>;

/// The squared distance, in widths, as ‖distances (f − goal)‖² of the features f of the state reached
/// (Task::feature_map). A reward of this form has analytic moments, which moment matching needs.
struct ClosedForm {
  Vector goal;       // one a feature
  Matrix distances;  // any × features: what has to vanish at the goal, in widths
};

/// exp(−d² / (2 width²)): 1 at the goal, 0 far away (Deisenroth 2015, eq. 44). `form`: the same once more, for learners
/// by moment matching.
Reward saturating(SquaredDistance squared_distance, double width, std::optional<ClosedForm> form = {});

/// The form that `saturating` was given; null where there is none. It lives as long as the reward.
const ClosedForm* closed_form(const Reward& reward);

}  // namespace rehearse::reward
