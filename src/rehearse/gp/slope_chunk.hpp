#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "rehearse/gp/prediction_chunk.hpp"

namespace rehearse::gp {

/// The scales of an output's inputs: `factors` (D) for inputs in unit range, and for the trend `trend_factors` (1 + D;
/// empty without one) for inputs as they are.
struct Scales {
  const Inputs& inputs;
  ConstVectorView factors, trend_factors;
};

/// Predictions with their derivatives by the inputs. With v = K⁻¹k the variance is k(x, x) − kᵀv, and its derivative
/// that of k(x, x) less 2 vᵀ∂k.
class SlopeChunk : public PredictionChunk {
 public:
  /// Predicts as `predict` does with variances, to the bit, and computes what `slopes` needs of the same output.
  void linearise(const PosteriorOutput& output, Index rows) {
    const Index D = output.points.rows(), support = output.support, others = output.weights.size() - support;
    const bool trend = output.trend_points.size() > 0;
    reserve(support, D, trend);
    const KernelPoints queries{scaled.data(), trend ? z.data() : nullptr};
    const KernelPoints points{output.points.data(), trend ? output.trend_points.data() : nullptr};
    correlate(points, support, D, output.weights.data(), queries, rows, columns.data(), means);
    triangular_solutions(output.inverse_factor.data(), support, columns.data(), rows, norms, solved.data());
    sum_slopes(points, support, D, output.weights.data(), queries, rows,
               {columns.data(), solved.data(), trend ? trends.data() : nullptr},
               {mean_sums.data(), variance_sums.data(), trend_sums.data()});
    if (others > 0) {
      const KernelPoints more{output.points.data() + support * D};
      const double* weights = output.weights.data() + support;
      correlate(more, others, D, weights, {scaled.data()}, rows, columns.data(), rest);
      sum_slopes(more, others, D, weights, {scaled.data()}, rows, {columns.data()},
                 {rest_sums.data(), nullptr, nullptr});
      for (Index q = 0; q < rows; ++q) means[q] += rest[q];
      for (Index i = 0; i < D * kChunk; ++i) mean_sums[at(i)] += rest_sums[at(i)];
    }
    if (trend) add_quadratic_form(output.trend_form.data(), D, unit.data(), rows, means);
  }

  /// Derivatives (rows × D, written) after `linearise`.
  void slopes(const PosteriorOutput& output, const Scales& scales, MatrixView mean_by, MatrixView variance_by) const {
    const Index D = output.points.rows(), rows = mean_by.rows();
    for (Index d = 0; d < D; ++d) {
      const double factor = scales.factors(d) / scales.inputs.half_range()(d);
      for (Index q = 0; q < rows; ++q) {
        mean_by(q, d) = factor * mean_sums[at(d * kChunk + q)];
        variance_by(q, d) = -2 * factor * variance_sums[at(d * kChunk + q)];
      }
    }
    if (output.trend_points.size() > 0) add_trend_slopes(output, scales, mean_by, variance_by);
    for (Index q = 0; q < rows; ++q) {
      variance_by.row(q) *= variance(q, output) > 0 ? output.signal_variance : 0;
      if (!missing[q]) continue;
      mean_by.row(q).setConstant(std::numeric_limits<double>::quiet_NaN());
      variance_by.row(q).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  void reserve(Index support, Index D, bool trend) {
    const auto enlarge = [](std::vector<double>& v, Index size) { v.resize(std::max(v.size(), at(size))); };
    enlarge(solved, support * kChunk);
    if (trend) enlarge(trends, support * kChunk);
    enlarge(mean_sums, D * kChunk), enlarge(variance_sums, D * kChunk), enlarge(rest_sums, D * kChunk);
    enlarge(trend_sums, (D + 1) * kChunk);
  }

  /// The mean has uᵀ A u with u = (1, x), the variance ‖z‖⁴ before any data and (z_i · z)² in k.
  void add_trend_slopes(const PosteriorOutput& output, const Scales& scales, MatrixView mean_by,
                        MatrixView variance_by) const {
    const Index D = output.points.rows(), rows = mean_by.rows();
    double norm[kChunk] = {};
    for (Index d = 0; d <= D; ++d)
      for (Index q = 0; q < rows; ++q) norm[q] += z[at(d * kChunk + q)] * z[at(d * kChunk + q)];
    for (Index d = 0; d < D; ++d) {
      const double factor = scales.trend_factors(d + 1), *own = z.data() + (d + 1) * kChunk;
      for (Index q = 0; q < rows; ++q)
        variance_by(q, d) += 4 * factor * (norm[q] * own[q] - trend_sums[at((d + 1) * kChunk + q)]);
      for (Index j = 0; j <= D; ++j) {
        const Index row = std::max(j, d + 1), column = std::min(j, d + 1);
        const double entry = output.trend_form(row * (row + 1) / 2 + column) * (row == column ? 2 : 1);
        const double slope = entry / scales.inputs.half_range()(d);
        for (Index q = 0; q < rows; ++q) mean_by(q, d) += slope * (j == 0 ? 1 : unit[at((j - 1) * kChunk + q)]);
      }
    }
  }

  std::vector<double> solved, trends;                                   // support × kChunk
  std::vector<double> mean_sums, variance_sums, rest_sums, trend_sums;  // D × kChunk, the last 1 + D
};

}  // namespace rehearse::gp
