#pragma once

#include <optional>

#include "rehearse/lqr/problem.hpp"

namespace rehearse::lqr {

/// A step about a state that stays, to first order: d' = A d + B v, with d the state's deviation and v the actions' one
/// in units of half their range.
struct LinearSystem {
  Matrix A, B;  // dx × dx, dx × du
};

/// The model's mean about a state and an action.
LinearSystem linear_system(const Problem& problem, const Vector& state, const Vector& action);

/// Feedback v = gain · d that minimises the sum of ½ Σ weight_i d_i² + ½ |v|² for ever, and that sum, ½ dᵀ S d.
struct Regulator {
  Matrix gain;  // du × dx
  Matrix S;     // dx × dx
};

/// The feedback of a system. weights: dx, ≥ 0. nullopt where no feedback makes it stable. Any thread.
std::optional<Regulator> regulate(const LinearSystem& system, const Vector& weights);

}  // namespace rehearse::lqr
