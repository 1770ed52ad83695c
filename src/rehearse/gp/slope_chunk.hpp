#pragma once

#include <algorithm>
#include <vector>

#include "rehearse/gp/prediction_chunk.hpp"

namespace rehearse::gp {

/// The scales of an output's inputs: `factors` (D) for inputs in unit range, and for the trend `trend_factors` (1 + D;
/// empty without one) for inputs as they are. `signs` of images (D): odd.hpp; empty without them.
struct Scales {
  const Inputs& inputs;
  ConstVectorView factors, trend_factors;
  const Vector& signs;
};

/// Predictions with their derivatives by the inputs. With v = K⁻¹k the variance is k(x, x) − kᵀv, and its derivative
/// that of k(x, x) less 2 vᵀ∂k.
class SlopeChunk : public PredictionChunk {
 public:
  /// Predicts as `predict` does with variances, to the bit, and computes what `slopes` needs of the same output.
  void linearise(const PosteriorOutput& output, Index rows) {
    const Index D = output.points.scaled.rows(), support = output.support, others = output.weights.size() - support;
    const bool trend = output.trend_form.size() > 0, odd = output.images.scaled.size() > 0;
    reserve(support, D, trend, odd);
    const KernelPoints queries{scaled.data(), trend ? z.data() : nullptr};
    const double* weights = output.weights.data();
    correlate(output.points.from(0), support, D, weights, queries, rows, columns.data(), means);
    if (odd) {
      correlate(output.images.from(0), support, D, weights, queries, rows, image_columns.data(), rest);
      for (Index q = 0; q < rows; ++q) means[q] -= rest[q];
      for (Index i = 0; i < support * width; ++i) differences[at(i)] = columns[at(i)] - image_columns[at(i)];
    }
    triangular_solutions(output.inverse_factor.data(), support, odd ? differences.data() : columns.data(), rows, norms,
                         solved.data());
    if (odd) std::copy_n(solved.begin(), support * width, differences.begin());
    double* products = trend ? trends.data() : nullptr;
    sum_slopes(output.points.from(0), support, D, weights, queries, rows, {columns.data(), solved.data(), products},
               {mean_sums.data(), variance_sums.data(), trend_sums.data()});
    if (odd) {
      sum_slopes(output.images.from(0), support, D, weights, queries, rows,
                 {image_columns.data(), differences.data(), products},
                 {image_mean_sums.data(), image_variance_sums.data(), image_trend_sums.data()});
      add(image_mean_sums, -1, mean_sums), add(image_variance_sums, -1, variance_sums);
      if (trend) add(image_trend_sums, -1, trend_sums);
    }
    if (others > 0) add_mean(output.points, output, rows, 1);
    if (others > 0 && odd) add_mean(output.images, output, rows, -1);
    if (trend) add_quadratic_form(output.trend_form.data(), D, unit.data(), rows, means);
  }

  /// Derivatives (rows × D, written) after `linearise`.
  void slopes(const PosteriorOutput& output, const Scales& scales, MatrixView mean_by, MatrixView variance_by) const {
    const Index D = output.points.scaled.rows(), rows = mean_by.rows();
    for (Index d = 0; d < D; ++d) {
      const double factor = scales.factors(d) / scales.inputs.half_range()(d);
      for (Index q = 0; q < rows; ++q) {
        mean_by(q, d) = factor * mean_sums[at(d * kChunk + q)];
        variance_by(q, d) = -2 * factor * variance_sums[at(d * kChunk + q)];
      }
    }
    if (scales.signs.size() > 0) add_image_slopes(scales, variance_by);
    if (output.trend_form.size() > 0) add_trend_slopes(output, scales, mean_by, variance_by);
    for (Index q = 0; q < rows; ++q) {
      variance_by.row(q) *= variance(q, output) > 0 ? output.signal_variance : 0;
      if (!missing[q]) continue;
      mean_by.row(q).setConstant(kNaN);
      variance_by.row(q).setConstant(kNaN);
    }
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  void reserve(Index support, Index D, bool trend, bool odd) {
    const auto enlarge = [](std::vector<double>& v, Index size) { v.resize(std::max(v.size(), at(size))); };
    enlarge(solved, support * kChunk);
    if (trend) enlarge(trends, support * kChunk);
    enlarge(mean_sums, D * kChunk), enlarge(variance_sums, D * kChunk), enlarge(rest_sums, D * kChunk);
    enlarge(trend_sums, (D + 1) * kChunk);
    if (!odd) return;
    enlarge(differences, support * kChunk);
    enlarge(image_mean_sums, D * kChunk), enlarge(image_variance_sums, D * kChunk);
    enlarge(image_trend_sums, (D + 1) * kChunk);
  }

  static void add(const std::vector<double>& from, double sign, std::vector<double>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += sign * from[i];
  }

  /// Adds to the means of the first rows, and to the sums of their derivatives, those of the points beyond the support,
  /// times the sign: 1 for the output's points, −1 for its images. The variance does not know these points.
  void add_mean(const PosteriorPoints& points, const PosteriorOutput& output, Index rows, double sign) {
    const Index D = points.scaled.rows(), count = output.weights.size() - output.support;
    const KernelPoints from{points.from(output.support).scaled};
    const double* weights = output.weights.data() + output.support;
    correlate(from, count, D, weights, {scaled.data()}, rows, columns.data(), rest);
    sum_slopes(from, count, D, weights, {scaled.data()}, rows, {columns.data()}, {rest_sums.data(), nullptr, nullptr});
    for (Index q = 0; q < rows; ++q) means[q] += sign * rest[q];
    add(rest_sums, sign, mean_sums);
  }

  /// The variance before any data lacks the correlation with the query's own image.
  void add_image_slopes(const Scales& scales, MatrixView variance_by) const {
    for (Index d = 0; d < variance_by.cols(); ++d) {
      if (scales.signs(d) > 0) continue;
      const double half_range = scales.inputs.half_range()(d), middle = scales.inputs.center()(d) / half_range;
      const double factor = 4 * scales.factors(d) * scales.factors(d) / half_range;
      for (Index q = 0; q < variance_by.rows(); ++q)
        if (image_correlations[q] > 0)  // or the other factor may be infinite
          variance_by(q, d) += factor * (unit[at(d * kChunk + q)] + middle) * image_correlations[q];
    }
  }

  /// The mean has uᵀ A u with u = (1, x), the variance ‖z‖⁴ before any data, less (z · z̄)² with images, and (z_i · z)²
  /// in k.
  void add_trend_slopes(const PosteriorOutput& output, const Scales& scales, MatrixView mean_by,
                        MatrixView variance_by) const {
    const Index D = output.points.scaled.rows(), rows = mean_by.rows();
    const bool odd = scales.signs.size() > 0;
    double norm[kChunk] = {};
    for (Index d = 0; d <= D; ++d)
      for (Index q = 0; q < rows; ++q) norm[q] += z[at(d * kChunk + q)] * z[at(d * kChunk + q)];
    for (Index d = 0; d < D; ++d) {
      const double factor = scales.trend_factors(d + 1), *own = z.data() + (d + 1) * kChunk;
      for (Index q = 0; q < rows; ++q) {
        const double before = odd ? norm[q] - scales.signs(d) * image_products[q] : norm[q];
        variance_by(q, d) += 4 * factor * (before * own[q] - trend_sums[at((d + 1) * kChunk + q)]);
      }
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
  std::vector<double> differences, image_mean_sums, image_variance_sums, image_trend_sums;  // the same of odd functions
};

}  // namespace rehearse::gp
