#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse {

/// A prediction of an episode of T steps: means and standard deviations by step; NaN where unknown.
struct ExpectedEpisode {
  Matrix states, state_deviations;    // T+1 × dx
  Vector rewards, reward_deviations;  // T

  /// An episode of which nothing is known: all numbers are NaN.
  static ExpectedEpisode unknown(Index steps, Index dx) {
    const Matrix by_state = Matrix::Constant(steps + 1, dx, kNaN);
    const Vector by_step = Vector::Constant(steps, kNaN);
    return {by_state, by_state, by_step, by_step};
  }
};

}  // namespace rehearse
