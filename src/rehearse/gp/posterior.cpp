#include "rehearse/gp/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/prediction_kernel.hpp"
#include "rehearse/gp/tiles.hpp"

namespace rehearse::gp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void check(const Inputs& inputs, const ConstMatrixView& Y, const std::vector<Hyperparameters>& hyperparameters) {
  Violations wrong;
  wrong.require(Y.rows() == inputs.size(),
                fmt::format("gp targets have {} rows, must be {}, those of the inputs", Y.rows(), inputs.size()));
  wrong.require(
      Y.cols() == static_cast<Index>(hyperparameters.size()),
      fmt::format("gp has {} sets of hyperparameters, must be {}, one per output", hyperparameters.size(), Y.cols()));
  wrong.require(Y.allFinite(), "gp targets are not finite");
  for (std::size_t e = 0; e < hyperparameters.size(); ++e)
    for (const std::string& line :
         violations(hyperparameters[e], inputs.dimensions(), fmt::format("gp hyperparameters[{}]", e)))
      wrong.add(line);
  wrong.throw_if_any();
}

/// Buffers of one thread for one chunk of queries.
struct Scratch {
  std::vector<double> unit, scaled, columns;  // D × kChunk, D × kChunk, n × kChunk
  bool missing[kChunk];                       // the row has a NaN
  double means[kChunk], norms[kChunk];

  void resize(Index n, Index D) {
    const auto enlarge = [](std::vector<double>& v, Index size) {
      v.resize(std::max(v.size(), static_cast<std::size_t>(size)));
    };
    enlarge(unit, D * kChunk), enlarge(scaled, D * kChunk), enlarge(columns, n * kChunk);
  }
};

/// The scratch of the calling thread.
Scratch& scratch(Index n, Index D) {
  thread_local Scratch mine;
  mine.resize(n, D);
  return mine;
}

/// Rows of F, as the training inputs are kept; a NaN marks its row and, like the padding, becomes 0.
void load_chunk(const Inputs& inputs, const ConstMatrixView& F, Index first, Index rows, Scratch& s) {
  std::fill(s.missing, s.missing + kChunk, false);
  for (Index d = 0; d < inputs.dimensions(); ++d) {
    const double center = inputs.center()(d), factor = 1 / inputs.half_range()(d);
    double* unit = s.unit.data() + d * kChunk;
    for (Index q = 0; q < rows; ++q) {
      const double value = (F(first + q, d) - center) * factor;
      const bool missing = std::isnan(value);
      unit[q] = missing ? 0 : value;
      s.missing[q] |= missing;
    }
    std::fill(unit + rows, unit + kChunk, 0.0);
  }
}

/// Calls predict_output(e, first row, rows, scratch) for each chunk of F's rows, scaled by each output's factors.
template <class PredictOutput>
void for_each_chunk(const Inputs& inputs, const Matrix& factors, const ConstMatrixView& F,
                    PredictOutput predict_output) {
  Scratch& s = scratch(inputs.size(), inputs.dimensions());
  for (Index first = 0; first < F.rows(); first += kChunk) {
    const Index rows = std::min<Index>(kChunk, F.rows() - first);
    load_chunk(inputs, F, first, rows, s);
    for (Index e = 0; e < factors.cols(); ++e) {
      for (Index k = 0; k < inputs.dimensions() * kChunk; ++k)
        s.scaled[static_cast<std::size_t>(k)] = s.unit[static_cast<std::size_t>(k)] * factors(k / kChunk, e);
      predict_output(e, first, rows, s);
    }
  }
}

}  // namespace

Posterior::Posterior(Inputs inputs, const ConstMatrixView& Y, std::vector<Hyperparameters> hyperparameters)
    : inputs_(std::move(inputs)), hyperparameters_(std::move(hyperparameters)) {
  check(inputs_, Y, hyperparameters_);
  const Index E = outputs(), n = size(), D = dimensions();
  factors_.resize(D, E), points_.resize(D, n * E), weights_.resize(n, E), inverse_factors_.resize(packed_size(n), E);
  signal_variances_.resize(E), noise_variances_.resize(E), log_evidences_.resize(E), jitters_.resize(E);
  Workspace workspace;
  for (Index e = 0; e < E; ++e) condition(e, Y.col(e), workspace);
}

void Posterior::condition(Index e, const ConstVectorView& y, Workspace& workspace) {
  const Index n = size();
  const Hyperparameters& theta = hyperparameters_[static_cast<std::size_t>(e)];
  const Evidence value = evidence(inputs_, y, theta.flat(), workspace);
  if (!value.ok()) throw InvalidInput(fmt::format("gp hyperparameters[{}] are too extreme to condition on data", e));
  signal_variances_(e) = theta.signal_variance();
  noise_variances_(e) = theta.noise_variance();
  log_evidences_(e) = value.value;
  jitters_(e) = value.jitter;
  factors_.col(e) = workspace.factors();
  points_.middleCols(e * n, n) = (inputs_.unit() * workspace.factors().asDiagonal()).transpose();
  weights_.col(e) = Eigen::Map<const Vector>(workspace.weights(), n) * std::exp(theta.log_signal);

  tiles_invert_factor(n, workspace.tiles());
  pack_inverse_factor(workspace.tiles(), n, inverse_factors_.col(e).data());
}

void Posterior::predict(const ConstMatrixView& F, MatrixView mean, MatrixView variance) const {
  for_each_chunk(inputs_, factors_, F, [&](Index e, Index first, Index rows, Scratch& s) {
    correlate(points(e), size(), dimensions(), weights_.col(e).data(), s.scaled.data(), rows, s.columns.data(),
              s.means);
    triangular_norms(inverse_factors_.col(e).data(), size(), s.columns.data(), rows, s.norms);
    for (Index q = 0; q < rows; ++q) {
      mean(first + q, e) = s.missing[q] ? kNaN : s.means[q];
      variance(first + q, e) = s.missing[q] ? kNaN : signal_variances_(e) * std::max(0.0, 1 - s.norms[q]);
    }
  });
}

void Posterior::predict_mean(const ConstMatrixView& F, MatrixView mean) const {
  for_each_chunk(inputs_, factors_, F, [&](Index e, Index first, Index rows, Scratch& s) {
    correlate(points(e), size(), dimensions(), weights_.col(e).data(), s.scaled.data(), rows, nullptr, s.means);
    for (Index q = 0; q < rows; ++q) mean(first + q, e) = s.missing[q] ? kNaN : s.means[q];
  });
}

Matrix Posterior::inverse_factor(Index e) const {
  Matrix inverse = Matrix::Zero(size(), size());
  for (Index j = 0; j < size(); ++j)
    for (Index i = j; i < size(); ++i) inverse(i, j) = packed_entry(inverse_factors_.col(e).data(), i, j);
  return inverse;
}

}  // namespace rehearse::gp
