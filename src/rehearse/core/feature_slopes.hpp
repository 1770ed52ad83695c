#pragma once
// The chain rule through a FeatureMap.

#include "rehearse/core/feature_map.hpp"

namespace rehearse {

/// F: what `map.apply` made of some states; by_features (rows × features): derivatives of a number of each row by its
/// features; by_states (rows × states), written: those of the same number by its states.
void pull_back_features(const FeatureMap& map, const ConstMatrixView& F, const ConstMatrixView& by_features,
                        MatrixView by_states);

/// Adds what the states count in the inputs that `map.apply_actions` makes of actions that are targets of them.
/// by_actions: rows × du.
void pull_back_targets(const FeatureMap& map, const ConstMatrixView& by_actions, MatrixView by_states);

}  // namespace rehearse
