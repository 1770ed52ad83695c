#include "rehearse/gp/evidence.hpp"

#include <cmath>
#include <limits>

#include "rehearse/gp/cholesky.hpp"
#include "rehearse/gp/kernel.hpp"
#include "rehearse/gp/sizes.hpp"

namespace rehearse::gp {
namespace {

constexpr int kWallPower = 30;

Evidence failure(Vector* gradient) {
  if (gradient) gradient->setConstant(kNaN);
  return {.value = kNaN, .jitter = kNaN};
}

/// (position / ln limit)^30 subtracted; its derivative with respect to the position returned.
double wall(double position, double limit, double& value) {
  const double t = position / std::log(limit);
  value -= std::pow(t, kWallPower);
  return -kWallPower * std::pow(t, kWallPower - 1) / std::log(limit);
}

/// D + 2 of them, or 2 D + 3.
void check_flat(const Inputs& inputs, const ConstVectorView& flat) {
  const Index D = inputs.dimensions();
  if (flat.size() != 2 * D + 3) require_size("log hyperparameters", flat.size(), D + 2);
}

/// b = (L Lᵀ)⁻¹ y / σ_f in place; returns y' b / σ_f = ‖L⁻¹ y‖² / σ_f².
double solve(Index n, const double* tiles, double* b) {
  tiles_solve(n, tiles, b);
  const double quadratic = Eigen::Map<const Vector>(b, n).squaredNorm();
  tiles_solve_transposed(n, tiles, b);
  return quadratic;
}

/// Scales the inputs and factorises K/σ_f² into the workspace's tiles; returns the jitter, NaN if that is not possible.
double factorise_at(const Inputs& inputs, const ConstVectorView& flat, const KnownNoise* noise, Workspace& workspace) {
  const Index D = inputs.dimensions();
  const double noise_ratio = std::exp(2 * (flat(D + 1) - flat(D)));
  if (!scale_inputs(inputs, flat, workspace) || !std::isfinite(noise_ratio) || !std::isfinite(std::exp(-flat(D))))
    return kNaN;
  return factorise({workspace.scaled(), inputs.size(), D, noise_ratio, workspace.trend(),
                    noise ? noise->tiles() : nullptr, std::exp(-2 * flat(D))},
                   workspace.tiles());
}

/// −½ ln |K| − n/2 ln 2π, from the factor of K/σ_f².
double log_constant(Index n, const double* tiles, double log_signal) {
  double sum = 0;
  for (Index i = 0; i < n; ++i) sum += std::log(tiles[entry_offset(i, i)]);
  return -sum - static_cast<double>(n) * (log_signal + kLogTwoPi / 2);
}

/// The evidence of targets y (n) from the factor of their covariance over σ_f², which the workspace's tiles hold, made
/// with this jitter; not finite where it cannot be computed. The workspace's weights become b.
Evidence of_factor(const ConstVectorView& y, double log_signal, double jitter, Workspace& workspace) {
  const Index n = y.size();
  Eigen::Map<Vector>(workspace.weights(), n) = y * std::exp(-log_signal);
  Eigen::Map<Vector>(workspace.weights() + n, padded(n) - n).setZero();
  const double quadratic = solve(n, workspace.tiles(), workspace.weights());
  return {.value = log_constant(n, workspace.tiles(), log_signal) - quadratic / 2, .jitter = jitter};
}

/// The workspace holds the factor, b and the scaled inputs; K = σ_f² (C + (noise_ratio + jitter) I).
bool differentiate(Index n, Index D, double noise_ratio, double jitter, Workspace& workspace, Vector& gradient) {
  tiles_invert_factor(n, workspace.tiles());
  tiles_multiply_inverse(n, workspace.tiles());
  const double* b = workspace.weights();
  double trace = 0;  // of b b' − (K/σ_f²)⁻¹
  for (Index i = 0; i < n; ++i) trace += b[i] * b[i] - workspace.tiles()[entry_offset(i, i)];
  gradient_sums(workspace.scaled(), n, D, b, workspace.tiles(), workspace.sums());
  gradient.head(D) = Eigen::Map<const Vector>(workspace.sums(), D);
  gradient(D) = 2 * workspace.sums()[D] + (1 + jitter) * trace;
  gradient(D + 1) = noise_ratio * trace;
  if (workspace.trend()) {
    trend_gradient_sums(workspace.trend(), n, D + 1, b, workspace.tiles(), workspace.sums());
    gradient.tail(D + 1) = 2 * Eigen::Map<const Vector>(workspace.sums(), D + 1);
  }
  return gradient.allFinite();
}

}  // namespace

bool Evidence::ok() const { return std::isfinite(value); }

void Workspace::resize(Index n, Index dimensions, bool trend) {
  const auto rows = static_cast<std::size_t>(padded(n)), columns = static_cast<std::size_t>(dimensions);
  tiles_.resize(static_cast<std::size_t>(tiles_size(n)));
  scaled_.resize(rows * columns);
  weights_.resize(rows);
  sums_.resize(8 * (columns + 1));
  factors_.resize(dimensions);
  trend_factors_.resize(trend ? dimensions + 1 : 0);
  trend_.resize(trend ? rows * (columns + 1) : 0);
}

bool scale_inputs(const Inputs& inputs, const ConstVectorView& flat, Workspace& workspace) {
  const Index n = inputs.size(), D = inputs.dimensions();
  workspace.resize(n, D, flat.size() > D + 2);
  workspace.factors() = inputs.half_range().array() * (-flat.head(D)).array().exp();
  workspace.trend_factors() = (flat.tail(workspace.trend_factors().size()).array() - flat(D) / 2).exp();
  if (!workspace.factors().allFinite() || !workspace.trend_factors().allFinite()) return false;
  scale_inputs(inputs.unit().data(), n, D, workspace.factors().data(), workspace.scaled());
  if (workspace.trend())
    trend_inputs(inputs.unit().data(), inputs.center().data(), inputs.half_range().data(), n, D,
                 workspace.trend_factors().data(), workspace.trend());
  return true;
}

KnownNoise::KnownNoise(const Matrix& covariance)
    : size_(covariance.rows()), tiles_(static_cast<std::size_t>(tiles_size(size_))) {
  require_shape("noise", covariance.rows(), covariance.cols(), size_, size_);
  for (Index j = 0; j < size_; ++j)
    for (Index i = j; i < size_; ++i) tiles_[static_cast<std::size_t>(entry_offset(i, j))] = covariance(i, j);
}

Evidence evidence(const Inputs& inputs, const ConstVectorView& y, const ConstVectorView& flat, Workspace& workspace,
                  Vector* gradient, const KnownNoise* noise) {
  const Index n = inputs.size(), D = inputs.dimensions();
  check_flat(inputs, flat);
  require_size("rows of targets", y.size(), n);
  if (noise) require_size("rows of noise", noise->size(), n);
  if (gradient) gradient->resize(flat.size());
  const double jitter = y.allFinite() ? factorise_at(inputs, flat, noise, workspace) : kNaN;
  if (std::isnan(jitter)) return failure(gradient);
  const Evidence found = of_factor(y, flat(D), jitter, workspace);
  if (!found.ok()) return failure(gradient);
  const double noise_ratio = std::exp(2 * (flat(D + 1) - flat(D)));
  if (gradient && !differentiate(n, D, noise_ratio, jitter, workspace, *gradient)) return failure(gradient);
  return found;
}

Evidence evidence(const Matrix& covariance, const ConstVectorView& y, const Hyperparameters& kernel,
                  Workspace& workspace) {
  const double noise_ratio = kernel.noise_variance() / kernel.signal_variance();
  const bool finite = covariance.allFinite() && y.allFinite() && std::isfinite(noise_ratio);
  const double jitter = finite ? factorise(covariance, noise_ratio, workspace.tiles()) : kNaN;
  if (std::isnan(jitter)) return failure(nullptr);
  const Evidence found = of_factor(y, kernel.log_signal, jitter, workspace);
  return found.ok() ? found : failure(nullptr);
}

Whitening::Whitening(const Inputs& inputs, const Hyperparameters& kernel)
    : size_(inputs.size()), inverse_signal_(std::exp(-kernel.log_signal)) {
  check_flat(inputs, kernel.flat());
  Workspace workspace;
  const double jitter = factorise_at(inputs, kernel.flat(), nullptr, workspace);
  log_constant_ = std::isnan(jitter) ? kNaN : log_constant(size_, workspace.tiles(), kernel.log_signal);
  tiles_ = std::move(workspace).release_tiles();
}

Matrix Whitening::operator()(const ConstMatrixView& Y) const {
  require_size("rows of targets", Y.rows(), size_);
  Matrix whitened = Matrix::Zero(padded(size_), Y.cols());
  whitened.topRows(size_) = Y * inverse_signal_;
  tiles_solve(size_, tiles_.data(), whitened.data(), Y.cols());
  return whitened.topRows(size_);
}

double Whitening::log_evidence(const ConstVectorView& whitened) const {
  require_size("rows of whitened targets", whitened.size(), size_);
  return log_constant_ - whitened.squaredNorm() / 2;
}

double penalty(const Inputs& inputs, const ConstVectorView& flat, const Penalties& penalties, Vector* gradient) {
  const Index D = inputs.dimensions();
  check_flat(inputs, flat);
  double value = 0;
  if (penalties.length) {
    for (Index d = 0; d < D; ++d) {
      const double slope = wall(flat(d) - std::log(inputs.spread()(d)), penalties.length_limit, value);
      if (gradient) (*gradient)(d) += slope;
    }
  }
  if (penalties.length_deviation > 0) {
    const double precision = 1 / (penalties.length_deviation * penalties.length_deviation);
    const auto deviations =
        flat.head(D).array() - (penalties.length_median * inputs.spread().array()).log();  // of ln ℓ from its median
    value -= precision * deviations.square().sum() / 2;
    if (gradient) gradient->head(D).array() -= precision * deviations;
  }
  if (penalties.snr) {
    const double slope = wall(flat(D) - flat(D + 1), penalties.snr_limit, value);
    if (gradient) (*gradient)(D) += slope, (*gradient)(D + 1) -= slope;
  }
  return value;
}

}  // namespace rehearse::gp
