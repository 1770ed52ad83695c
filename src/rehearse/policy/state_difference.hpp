#pragma once

#include "rehearse/core/turns.hpp"

namespace rehearse::policy {

/// Writes a state variable (a column of rows) less where it is to be, one number or one a row; of an angle the shorter
/// way round. States beyond ±1e100 count as that, so that nothing overflows.
template <class Reference>
void difference_from(const Reference& reference, bool angle, const ConstVectorView& states,
                     Eigen::Ref<Eigen::ArrayXd> difference) {
  constexpr double kLargestState = 1e100;
  difference = states.array().min(kLargestState).max(-kLargestState) - reference;
  if (angle) difference -= kTurn * (difference / kTurn + 0.5).floor();
}

}  // namespace rehearse::policy
