#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::policy {

inline constexpr double kLargestLogLength = 20;  // beyond it a kernel is as good as constant, or nothing

struct RbfShape {
  Index inputs, centres, actions;
  double noise;  // σ_n

  bool operator==(const RbfShape&) const = default;
  Index parameters() const { return inputs * actions + centres * inputs + centres * actions; }
};

/// Writes `out` (n × actions), the mean of the policy's GP before the squash. Every row of the batch has its own θ
/// (n × parameters(); see rbf.hpp) and inputs (n × D). Strides are those between columns. No allocation after a
/// thread's first call, and no factorisation where θ is that of the rows before.
void rbf(const RbfShape& shape, const double* theta, Index theta_stride, const double* in, Index in_stride, double* out,
         Index out_stride, Index rows);

}  // namespace rehearse::policy
