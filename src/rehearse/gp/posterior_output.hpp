#pragma once

#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/gp/prediction_kernel.hpp"

namespace rehearse::gp {

/// Inputs that covariances with queries are computed from.
struct PosteriorPoints {
  Matrix scaled;  // D × m: inputs / ℓ, one a column
  Matrix trend;   // 1 + D × m: z of the trend (kernel.hpp); empty without one

  KernelPoints from(Index i) const {
    return {scaled.data() + i * scaled.rows(), trend.size() > 0 ? trend.data() + i * trend.rows() : nullptr};
  }
  PosteriorPoints at(const std::vector<Index>& order) const {
    return {scaled(Eigen::all, order), trend(Eigen::all, order)};
  }
};

/// The numbers from which predictions of one output of a posterior are computed.
struct PosteriorOutput {
  PosteriorPoints points;  // m; the variance needs the first `support`
  PosteriorPoints images;  // of the points, whose covariances are subtracted where the function is odd; or empty
  Vector weights;          // m
  Vector trend_form;       // the trend's part of the mean, as add_quadratic_form reads it with unit inputs; or empty
  Index support = 0;       // s
  Vector inverse_factor;   // packed_size(s): L⁻¹, see prediction_kernel.hpp
  double signal_variance = 0;
};

}  // namespace rehearse::gp
