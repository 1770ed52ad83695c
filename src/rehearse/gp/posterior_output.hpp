#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// The numbers from which predictions of one output of a posterior are computed.
struct PosteriorOutput {
  Matrix points;          // D × m: inputs / ℓ, one a column; the variance needs the first `support`
  Matrix trend_points;    // 1 + D × m: z of the trend (kernel.hpp); empty without one
  Vector weights;         // m
  Vector trend_form;      // the trend's part of the mean, as add_quadratic_form reads it with unit inputs; or empty
  Index support = 0;      // s
  Vector inverse_factor;  // packed_size(s): L⁻¹, see prediction_kernel.hpp
  double signal_variance = 0;
};

}  // namespace rehearse::gp
