#include "rehearse/gp/posterior.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/tiles.hpp"
#include "rehearse/gp/cholesky.hpp"
#include "rehearse/gp/compression.hpp"
#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/odd.hpp"
#include "rehearse/gp/prediction_chunk.hpp"
#include "rehearse/gp/sizes.hpp"
#include "rehearse/gp/slope_chunk.hpp"

namespace rehearse::gp {
namespace {

/// Errors are measured at few inputs; elsewhere they may be several times larger.
constexpr double kMargin = 0.2;

void check(const Inputs& inputs, const ConstMatrixView& Y, const std::vector<Hyperparameters>& hyperparameters) {
  Violations wrong;
  wrong.require(Y.rows() == inputs.size(),
                fmt::format("gp targets have {} rows, must be {}, those of the inputs", Y.rows(), inputs.size()));
  wrong.require(
      Y.cols() == static_cast<Index>(hyperparameters.size()),
      fmt::format("gp has {} sets of hyperparameters, must be {}, one per output", hyperparameters.size(), Y.cols()));
  wrong.require(Y.allFinite(), "gp targets are not finite");
  for (const Hyperparameters& one : hyperparameters)
    wrong.require(one.has_trend() == hyperparameters.front().has_trend(),
                  "some outputs of a gp have a trend, some none");
  for (std::size_t e = 0; e < hyperparameters.size(); ++e)
    for (const std::string& line :
         violations(hyperparameters[e], inputs.dimensions(), fmt::format("gp hyperparameters[{}]", e)))
      wrong.add(line);
  wrong.throw_if_any();
}

/// The lower triangle of the covariances over σ_f² of the inputs that `evidence` has scaled.
Matrix correlations(Index n, Index D, Workspace& workspace) {
  correlation_matrix(workspace.scaled(), n, D, 1, workspace.tiles());
  if (workspace.trend()) add_trend(workspace.trend(), n, D + 1, workspace.tiles());
  Matrix C(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) C(i, j) = workspace.tiles()[entry_offset(i, j)];
  return C;
}

/// The inverse of the factor in `tiles`, as predictions read it.
Vector packed_inverse(Index n, double* tiles) {
  tiles_invert_factor(n, tiles);
  Vector packed(packed_size(n));
  pack_inverse_factor(tiles, n, packed.data());
  return packed;
}

/// Below this ratio of σ_n² to the largest variance of a point the trace that may be left out drowns in the rounding of
/// a covariance matrix.
constexpr double kLeastNoiseRatio = 1e-7;

/// The trace to leave out, in units of σ_n² (compression.hpp). √t = tolerance · √ρ keeps the error below
/// tolerance · σ_n s̃/σ_f at every input, and so below tolerance · σ_n where s̃ ≤ σ_f. Small ρ would need more digits for
/// that than there are; t = 2ρ is measured to be enough (docs/performance.md).
double remainder(double noise_ratio, double tolerance) {
  const double share = noise_ratio >= 0.01 ? noise_ratio : 2e4 * noise_ratio;
  return tolerance * tolerance * std::min(share, 1.0);
}

}  // namespace

/// Calls visit(first row, rows, chunk) for each chunk of F's rows.
template <class Chunk, class Visit>
void Posterior::for_each_chunk(const ConstMatrixView& F, Visit visit) const {
  thread_local Chunk s;
  s.resize(size(), dimensions());
  if (odd()) s.resize_for_images(size());
  for (Index first = 0; first < F.rows(); first += kChunk) {
    const Index rows = std::min<Index>(kChunk, F.rows() - first);
    s.load(inputs_, F, first, rows);
    visit(first, rows, s);
  }
}

Posterior::Posterior(Inputs inputs, const ConstMatrixView& Y, std::vector<Hyperparameters> hyperparameters,
                     double tolerance, Vector signs)
    : inputs_(std::move(inputs)), hyperparameters_(std::move(hyperparameters)), signs_(std::move(signs)) {
  if (odd()) require_size("signs of images", signs_.size(), dimensions());
  check(inputs_, Y, hyperparameters_);
  const Index E = outputs();
  factors_.resize(dimensions(), E);
  trend_factors_.resize(hyperparameters_.empty() ? 0 : hyperparameters_.front().log_trend.size(), E);
  noise_variances_.resize(E), log_evidences_.resize(E), jitters_.resize(E);
  Workspace workspace;
  for (Index e = 0; e < E; ++e) {
    const Matrix odd_C =
        odd() ? odd_covariance(inputs_, signs_, hyperparameters_[static_cast<std::size_t>(e)]) : Matrix();
    Output exact = condition(e, Y.col(e), odd_C, workspace);
    std::optional<Output> few = compress(e, Y.col(e), exact, tolerance, odd_C, workspace);
    outputs_.push_back(few ? std::move(*few) : std::move(exact));
    outputs_.back().trend_form = trend_form(e, outputs_.back());
  }
}

Posterior::Output Posterior::condition(Index e, const ConstVectorView& y, const Matrix& odd_C, Workspace& workspace) {
  const Index n = size();
  const Hyperparameters& theta = hyperparameters_[static_cast<std::size_t>(e)];
  Evidence value{.value = kNaN};
  if (!odd())
    value = evidence(inputs_, y, theta.flat(), workspace);
  else if (scale_inputs(inputs_, theta.flat(), workspace))
    value = evidence(odd_C, y, theta, workspace);
  if (!value.ok()) throw InvalidInput(fmt::format("gp hyperparameters[{}] are too extreme to condition on data", e));
  noise_variances_(e) = theta.noise_variance();
  log_evidences_(e) = value.value;
  jitters_(e) = value.jitter;
  factors_.col(e) = workspace.factors();
  trend_factors_.col(e) = workspace.trend_factors();
  Output output{.points = scaled(e, inputs_.unit()),
                .images = odd() ? scaled(e, unit_images(inputs_, signs_)) : PosteriorPoints{},
                .weights = Vector::Map(workspace.weights(), n) * std::exp(theta.log_signal),
                .trend_form = {},
                .support = n,
                .inverse_factor = {},
                .signal_variance = theta.signal_variance()};
  output.inverse_factor = packed_inverse(n, workspace.tiles());
  return output;
}

/// z = M (1, x), x the unit inputs.
Matrix Posterior::trend_map(Index e) const {
  const auto factors = trend_factors_.col(e);
  Matrix map = Matrix::Zero(factors.size(), factors.size());
  if (factors.size() == 0) return map;
  map(0, 0) = factors(0);
  for (Index d = 0; d < dimensions(); ++d) {
    map(d + 1, 0) = inputs_.center()(d) * factors(d + 1);
    map(d + 1, d + 1) = inputs_.half_range()(d) * factors(d + 1);
  }
  return map;
}

PosteriorPoints Posterior::scaled(Index e, const Matrix& unit) const {
  const Matrix map = trend_map(e);
  Matrix trend(0, unit.rows());
  if (map.size() > 0) trend = (map.rightCols(dimensions()) * unit.transpose()).colwise() + map.col(0);
  return {.scaled = (unit * factors_.col(e).asDiagonal()).transpose(), .trend = std::move(trend)};
}

/// Σ_i w_i (z · z_i)² = xᵀ Mᵀ Z W Zᵀ M x, less that of images.
Vector Posterior::trend_form(Index e, const Output& output) const {
  const Matrix map = trend_map(e).transpose();
  const auto form_of = [&](const PosteriorPoints& points) {
    const Matrix Z = map * points.trend;
    return Matrix(Z * output.weights.asDiagonal() * Z.transpose());
  };
  Matrix A = form_of(output.points);
  if (odd()) A -= form_of(output.images);
  Vector form(A.rows() * (A.rows() + 1) / 2);
  double* entry = form.data();
  for (Index i = 0; i < A.rows(); ++i)
    for (Index j = 0; j <= i; ++j) *entry++ = i == j ? A(i, i) : A(i, j) + A(j, i);
  return form;
}

/// The workspace holds the inputs scaled for this output.
std::optional<Posterior::Output> Posterior::compress(Index e, const ConstVectorView& y, const Output& exact,
                                                     double tolerance, const Matrix& odd_C,
                                                     Workspace& workspace) const {
  if (tolerance <= 0) return std::nullopt;
  const double noise_ratio = noise_variances_(e) / exact.signal_variance + jitters_(e);
  if (noise_ratio < kLeastNoiseRatio) return std::nullopt;  // before C is made
  const auto worthwhile = static_cast<Index>(0.75 * static_cast<double>(size()));
  const Matrix C = odd() ? odd_C : correlations(size(), dimensions(), workspace);
  double largest = C.diagonal().maxCoeff();
  if (odd() && exact.points.trend.size() > 0)  // C is a difference of covariances of that size
    largest = 1 + std::pow(exact.points.trend.colwise().squaredNorm().maxCoeff(), 2);
  if (noise_ratio < kLeastNoiseRatio * largest) return std::nullopt;
  const auto summary = summarise(C, noise_ratio, y, exact.weights, remainder(noise_ratio, tolerance), worthwhile);
  if (!summary) return std::nullopt;
  std::optional<Output> few = condition(*summary, exact, workspace);
  if (!few) return std::nullopt;
  const double noise = std::sqrt(noise_variances_(e));
  if (!(deviation_error(e, exact, *few) <= kMargin * tolerance * noise)) return std::nullopt;
  if (!(summary->mean_error <= tolerance * noise)) use_all_for_mean(exact, summary->points, *few);
  return few;
}

std::optional<Posterior::Output> Posterior::condition(const Summary& summary, const Output& exact,
                                                      Workspace& workspace) {
  const auto r = static_cast<Index>(summary.points.size());
  lower_to_tiles(summary.covariance, workspace.tiles());
  if (!tiles_cholesky(r, workspace.tiles())) return std::nullopt;
  Vector weights = Vector::Zero(padded(r));
  weights.head(r) = summary.targets;
  tiles_solve(r, workspace.tiles(), weights.data());
  tiles_solve_transposed(r, workspace.tiles(), weights.data());
  return Output{.points = exact.points.at(summary.points),
                .images = exact.images.scaled.size() > 0 ? exact.images.at(summary.points) : PosteriorPoints{},
                .weights = weights.head(r),
                .trend_form = {},
                .support = r,
                .inverse_factor = packed_inverse(r, workspace.tiles()),
                .signal_variance = exact.signal_variance};
}

/// The mean of `exact`, the variance of `few`.
void Posterior::use_all_for_mean(const Output& exact, std::vector<Index> order, Output& few) {
  std::vector<bool> first(static_cast<std::size_t>(exact.support), false);
  for (const Index i : order) first[static_cast<std::size_t>(i)] = true;
  for (Index i = 0; i < exact.support; ++i)
    if (!first[static_cast<std::size_t>(i)]) order.push_back(i);
  few.points = exact.points.at(order);
  if (exact.images.scaled.size() > 0) few.images = exact.images.at(order);
  few.weights = exact.weights(order);
}

/// Scales a chunk's queries for an output, and says what their variances are before any data.
void Posterior::scale(Index e, PredictionChunk& s) const {
  s.scale(factors_.col(e));
  s.expand(inputs_, trend_factors_.col(e));
  if (odd()) s.subtract_images(inputs_, signs_, factors_.col(e), trend_factors_.rows() > 0);
}

/// The largest difference between the two standard deviations that was met.
double Posterior::deviation_error(Index e, const Output& exact, const Output& other) const {
  double error = 0;
  for_each_chunk<PredictionChunk>(probes(inputs_), [&](Index, Index rows, PredictionChunk& s) {
    scale(e, s);
    s.predict(exact, rows, false);
    Vector deviation(rows);
    for (Index q = 0; q < rows; ++q) deviation(q) = std::sqrt(s.variance(q, exact));
    s.predict(other, rows, false);
    for (Index q = 0; q < rows; ++q) error = std::max(error, std::abs(std::sqrt(s.variance(q, other)) - deviation(q)));
  });
  return error;
}

/// Calls write(row, its place in the chunk, output, chunk) for each row of F and each output.
template <class Write>
void Posterior::predict(const ConstMatrixView& F, bool only_mean, Write write) const {
  for_each_chunk<PredictionChunk>(F, [&](Index first, Index rows, PredictionChunk& s) {
    for (Index e = 0; e < outputs(); ++e) {
      if (only_mean)
        s.scale(factors_.col(e));
      else
        scale(e, s);
      s.predict(output(e), rows, only_mean);
      for (Index q = 0; q < rows; ++q) write(first + q, q, e, s);
    }
  });
}

void Posterior::predict(const ConstMatrixView& F, MatrixView mean, MatrixView variance) const {
  require_shape("inputs", F.rows(), F.cols(), F.rows(), dimensions());
  require_shape("mean", mean.rows(), mean.cols(), F.rows(), outputs());
  require_shape("variance", variance.rows(), variance.cols(), F.rows(), outputs());
  predict(F, false, [&](Index row, Index q, Index e, const PredictionChunk& s) {
    mean(row, e) = s.mean(q);
    variance(row, e) = s.variance(q, output(e));
  });
}

void Posterior::predict_mean(const ConstMatrixView& F, MatrixView mean) const {
  require_shape("inputs", F.rows(), F.cols(), F.rows(), dimensions());
  require_shape("mean", mean.rows(), mean.cols(), F.rows(), outputs());
  predict(F, true, [&](Index row, Index q, Index e, const PredictionChunk& s) { mean(row, e) = s.mean(q); });
}

void Posterior::linearise(const ConstMatrixView& F, MatrixView mean, MatrixView variance, MatrixView mean_by,
                          MatrixView variance_by) const {
  const Index D = dimensions();
  require_shape("inputs", F.rows(), F.cols(), F.rows(), D);
  for (const MatrixView* values : {&mean, &variance})
    require_shape("predictions", values->rows(), values->cols(), F.rows(), outputs());
  for (const MatrixView* slopes : {&mean_by, &variance_by})
    require_shape("derivatives", slopes->rows(), slopes->cols(), F.rows(), outputs() * D);
  for_each_chunk<SlopeChunk>(F, [&](Index first, Index rows, SlopeChunk& s) {
    for (Index e = 0; e < outputs(); ++e) {
      scale(e, s);
      s.linearise(output(e), rows);
      for (Index q = 0; q < rows; ++q) mean(first + q, e) = s.mean(q);
      for (Index q = 0; q < rows; ++q) variance(first + q, e) = s.variance(q, output(e));
      const Scales scales{inputs_, factors_.col(e), trend_factors_.col(e), signs_};
      s.slopes(output(e), scales, mean_by.block(first, e * D, rows, D), variance_by.block(first, e * D, rows, D));
    }
  });
}

Matrix Posterior::inverse_factor(Index e) const {
  const Index n = output(e).support;
  Matrix inverse = Matrix::Zero(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) inverse(i, j) = packed_entry(output(e).inverse_factor.data(), i, j);
  return inverse;
}

}  // namespace rehearse::gp
