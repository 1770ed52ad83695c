#include "rehearse/gp/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/blas.hpp"
#include "rehearse/gp/cholesky.hpp"
#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/kernel.hpp"

namespace rehearse::gp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Index kGroup = 4;  // queries that the kernel takes together

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
  std::vector<double> unit, scaled, columns;
  std::vector<char> missing;  // the row has a NaN
  double means[Posterior::kChunk], norms[Posterior::kChunk];

  void resize(Index n, Index D) {
    unit.resize(static_cast<std::size_t>(Posterior::kChunk * D));
    scaled.resize(unit.size());
    columns.resize(std::max(columns.size(), static_cast<std::size_t>(padded(n) * Posterior::kChunk)));
    missing.resize(Posterior::kChunk);
  }
};

/// The scratch of the calling thread.
Scratch& scratch(Index n, Index D) {
  thread_local Scratch mine;
  mine.resize(n, D);
  return mine;
}

/// Rows of F, as the training inputs are kept; NaN rows are marked and, like the padding, replaced by zeros.
void load_chunk(const Inputs& inputs, const ConstMatrixView& F, Index first, Index rows, Scratch& s) {
  const Index D = inputs.dimensions();
  std::fill(s.missing.begin(), s.missing.end(), 0);
  std::fill(s.unit.begin(), s.unit.end(), 0.0);
  for (Index d = 0; d < D; ++d) {
    const double half_range = inputs.half_range()(d), shift = inputs.center()(d) / half_range;
    for (Index q = 0; q < rows; ++q) {
      const double value = F(first + q, d) / half_range - shift;
      if (std::isnan(value))
        s.missing[static_cast<std::size_t>(q)] = 1;
      else
        s.unit[static_cast<std::size_t>(q * D + d)] = value;
    }
  }
}

void scale_chunk(const Vector& factors, Scratch& s) {
  const auto D = static_cast<std::size_t>(factors.size());
  for (std::size_t k = 0; k < s.unit.size(); k += D)
    for (std::size_t d = 0; d < D; ++d) s.scaled[k + d] = s.unit[k + d] * factors(static_cast<Index>(d));
}

/// Calls predict_output(e, first row, rows, scratch) for each chunk of F's rows, scaled by each output's factors.
template <class PredictOutput>
void for_each_chunk(const Inputs& inputs, const std::vector<Vector>& factors, const ConstMatrixView& F,
                    PredictOutput predict_output) {
  Scratch& s = scratch(inputs.size(), inputs.dimensions());
  for (Index first = 0; first < F.rows(); first += Posterior::kChunk) {
    const Index rows = std::min(Posterior::kChunk, F.rows() - first);
    load_chunk(inputs, F, first, rows, s);
    for (std::size_t e = 0; e < factors.size(); ++e) {
      scale_chunk(factors[e], s);
      predict_output(static_cast<Index>(e), first, rows, s);
    }
  }
}

/// columns ← L⁻¹ columns. Always kChunk of them and whole vectors of rows, so that rounding does not depend on how
/// many rows came nor, in OpenBLAS 0.3.21, on a row's place among them: its kernel for the last n mod 8 rows does.
void multiply_chunk(const Matrix& inverse_factor, double* columns) {
  const int n = static_cast<int>(inverse_factor.rows()), chunk = static_cast<int>(Posterior::kChunk);
  const double one = 1;
  dtrmm_("L", "L", "N", "N", &n, &chunk, &one, inverse_factor.data(), &n, columns, &n);
}

}  // namespace

Posterior::Posterior(Inputs inputs, const ConstMatrixView& Y, std::vector<Hyperparameters> hyperparameters)
    : inputs_(std::move(inputs)), hyperparameters_(std::move(hyperparameters)) {
  check(inputs_, Y, hyperparameters_);
  const Index E = outputs(), n = size();
  weights_ = Matrix::Zero(padded(n), E);
  signal_variances_.resize(E), noise_variances_.resize(E), log_evidences_.resize(E), jitters_.resize(E);
  for (Index e = 0; e < E; ++e) condition(e, Y.col(e));
}

void Posterior::condition(Index e, const ConstVectorView& y) {
  const Index n = size(), D = dimensions();
  const Hyperparameters& theta = hyperparameters_[static_cast<std::size_t>(e)];
  Workspace workspace;
  const Evidence value = evidence(inputs_, y, theta.flat(), workspace);
  if (!value.ok()) throw InvalidInput(fmt::format("gp hyperparameters[{}] are too extreme to condition on data", e));
  signal_variances_(e) = theta.signal_variance();
  noise_variances_(e) = theta.noise_variance();
  log_evidences_(e) = value.value;
  jitters_(e) = value.jitter;
  factors_.push_back(workspace.factors());
  scaled_.emplace_back(Eigen::Map<const Matrix>(workspace.scaled(), padded(n), D));
  weights_.col(e) = Eigen::Map<const Vector>(workspace.weights(), padded(n)) * std::exp(theta.log_signal);

  const int size = static_cast<int>(n), stride = static_cast<int>(padded(n));
  int info = 0;
  dtrtri_("L", "N", &size, workspace.matrix(), &stride, &info);
  Matrix inverse = Matrix::Zero(padded(n), padded(n));
  inverse.topLeftCorner(n, n).triangularView<Eigen::Lower>() =
      Eigen::Map<const Matrix>(workspace.matrix(), padded(n), n).topRows(n);
  inverse_factors_.push_back(std::move(inverse));
}

void Posterior::predict(const ConstMatrixView& F, MatrixView mean, MatrixView variance) const {
  for_each_chunk(inputs_, factors_, F, [&](Index e, Index first, Index rows, Scratch& s) {
    correlate(scaled_[static_cast<std::size_t>(e)].data(), size(), dimensions(), weights_.col(e).data(),
              s.scaled.data(), kChunk, s.columns.data(), s.means);
    multiply_chunk(inverse_factors_[static_cast<std::size_t>(e)], s.columns.data());
    squared_norms(s.columns.data(), size(), kChunk, s.norms);
    for (Index q = 0; q < rows; ++q) {
      const bool missing = s.missing[static_cast<std::size_t>(q)];
      mean(first + q, e) = missing ? kNaN : s.means[q];
      variance(first + q, e) = missing ? kNaN : signal_variances_(e) * std::max(0.0, 1 - s.norms[q]);
    }
  });
}

void Posterior::predict_mean(const ConstMatrixView& F, MatrixView mean) const {
  for_each_chunk(inputs_, factors_, F, [&](Index e, Index first, Index rows, Scratch& s) {
    correlate(scaled_[static_cast<std::size_t>(e)].data(), size(), dimensions(), weights_.col(e).data(),
              s.scaled.data(), (rows + kGroup - 1) / kGroup * kGroup, nullptr, s.means);
    for (Index q = 0; q < rows; ++q) mean(first + q, e) = s.missing[static_cast<std::size_t>(q)] ? kNaN : s.means[q];
  });
}

}  // namespace rehearse::gp
