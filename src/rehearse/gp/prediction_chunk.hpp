#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "rehearse/core/vector_math.hpp"
#include "rehearse/gp/inputs.hpp"
#include "rehearse/gp/kernel.hpp"
#include "rehearse/gp/posterior_output.hpp"
#include "rehearse/gp/prediction_kernel.hpp"

namespace rehearse::gp {

/// Predictions for one chunk of queries, at most kChunk rows, in buffers that a thread reuses. Not shared between
/// threads.
class PredictionChunk {
 public:
  void resize(Index n, Index D) {
    const auto enlarge = [](std::vector<double>& v, Index size) {
      v.resize(std::max(v.size(), static_cast<std::size_t>(size)));
    };
    enlarge(unit, D * kChunk), enlarge(scaled, D * kChunk), enlarge(columns, n * kChunk);
    enlarge(z, (D + 1) * kChunk);
  }
  void resize_for_images(Index n) {
    image_columns.resize(std::max(image_columns.size(), static_cast<std::size_t>(n * kChunk)));
  }

  /// Rows of F, as the training inputs are kept; a NaN marks its row and, like the padding, becomes 0.
  void load(const Inputs& inputs, const ConstMatrixView& F, Index first, Index rows) {
    width = (rows + kGroup - 1) / kGroup * kGroup;
    std::fill(missing, missing + rows, false);
    for (Index d = 0; d < inputs.dimensions(); ++d) {
      const double center = inputs.center()(d), factor = 1 / inputs.half_range()(d);
      double* row = unit.data() + d * kChunk;
      for (Index q = 0; q < rows; ++q) {
        const double value = (F(first + q, d) - center) * factor;
        const bool nan = std::isnan(value);
        row[q] = nan ? 0 : value;
        missing[q] |= nan;
      }
      std::fill(row + rows, row + width, 0.0);
    }
  }

  void scale(const ConstVectorView& factors) {
    for (Index d = 0; d < factors.size(); ++d) {
      const double factor = factors(d), *from = unit.data() + d * kChunk;
      double* to = scaled.data() + d * kChunk;
      for (Index q = 0; q < width; ++q) to[q] = from[q] * factor;
    }
  }

  /// z, and the variance over σ_f² before any data.
  void expand(const Inputs& inputs, const ConstVectorView& factors) {
    std::fill(priors, priors + width, 1.0);
    if (factors.size() == 0) return;
    double norm[kChunk];
    std::fill(z.data(), z.data() + width, factors(0));
    std::fill(norm, norm + width, factors(0) * factors(0));
    for (Index d = 0; d < inputs.dimensions(); ++d) {
      const double slope = inputs.half_range()(d) * factors(d + 1), offset = inputs.center()(d) * factors(d + 1);
      const double* from = unit.data() + d * kChunk;
      double* to = z.data() + (d + 1) * kChunk;
      for (Index q = 0; q < width; ++q) {
        to[q] = from[q] * slope + offset;
        norm[q] += to[q] * to[q];
      }
    }
    for (Index q = 0; q < width; ++q) priors[q] += norm[q] * norm[q];
  }

  /// After `expand`, of an odd function (odd.hpp): its variance over σ_f² before any data.
  void subtract_images(const Inputs& inputs, const Vector& signs, const ConstVectorView& factors, bool trend) {
    double squared[kChunk] = {};
    for (Index d = 0; d < inputs.dimensions(); ++d) {
      if (signs(d) > 0) continue;
      const double middle = inputs.center()(d) / inputs.half_range()(d);
      const double* from = unit.data() + d * kChunk;
      for (Index q = 0; q < width; ++q) {
        const double difference = 2 * factors(d) * (from[q] + middle);
        squared[q] += difference * difference;
      }
    }
    for (Index q = 0; q < width; ++q) image_correlations[q] = -0.5 * squared[q];
    vector_exp(image_correlations, image_correlations, width);
    for (Index q = 0; q < width; ++q) priors[q] -= image_correlations[q];
    if (!trend) return;
    for (Index q = 0; q < width; ++q)
      image_products[q] = z[static_cast<std::size_t>(q)] * z[static_cast<std::size_t>(q)];
    for (Index d = 0; d < inputs.dimensions(); ++d) {
      const double* own = z.data() + (d + 1) * kChunk;
      for (Index q = 0; q < width; ++q) image_products[q] += signs(d) * own[q] * own[q];
    }
    for (Index q = 0; q < width; ++q) priors[q] -= image_products[q] * image_products[q];
  }

  /// `means`, and unless only these are asked for `norms`, of the first rows.
  void predict(const PosteriorOutput& output, Index rows, bool only_mean) {
    const Index D = output.points.scaled.rows(), support = output.support, others = output.weights.size() - support;
    const bool trend = output.points.trend.size() > 0, odd = output.images.scaled.size() > 0;
    const KernelPoints queries{scaled.data(), trend ? z.data() : nullptr};
    const auto add = [&](const PosteriorPoints& points, Index first, Index count, double* to, double sign) {
      correlate(points.from(first), count, D, output.weights.data() + first, queries, rows, to, rest);
      for (Index q = 0; q < rows; ++q) means[q] += sign * rest[q];
    };
    correlate(output.points.from(0), support, D, output.weights.data(), queries, rows,
              only_mean ? nullptr : columns.data(), means);
    if (odd) {
      add(output.images, 0, support, only_mean ? nullptr : image_columns.data(), -1);
      if (!only_mean)
        for (std::size_t i = 0; i < static_cast<std::size_t>(support * width); ++i) columns[i] -= image_columns[i];
    }
    if (others > 0) add(output.points, support, others, nullptr, 1);
    if (others > 0 && odd) add(output.images, support, others, nullptr, -1);
    if (output.trend_form.size() > 0) add_quadratic_form(output.trend_form.data(), D, unit.data(), rows, means);
    if (!only_mean) triangular_norms(output.inverse_factor.data(), support, columns.data(), rows, norms);
  }

  double mean(Index q) const { return missing[q] ? kNaN : means[q]; }
  double variance(Index q, const PosteriorOutput& output) const {
    return missing[q] ? kNaN : output.signal_variance * std::max(0.0, priors[q] - norms[q]);
  }

 protected:
  std::vector<double> unit, scaled, z, columns;  // D × kChunk, D × kChunk, (1 + D) × kChunk, n × kChunk
  std::vector<double> image_columns;             // n × kChunk, of odd functions
  Index width = 0;                               // rows of the chunk, and padding, which is finite
  bool missing[kChunk];                          // the row has a NaN
  double means[kChunk], rest[kChunk], norms[kChunk], priors[kChunk];
  double image_correlations[kChunk], image_products[kChunk];  // of each query with its own image, the latter of z
};

}  // namespace rehearse::gp
