#include "rehearse/moments/rbf_policy.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/cholesky.hpp"
#include "rehearse/gp/correlations.hpp"
#include "rehearse/gp/kernel.hpp"
#include "rehearse/policy/rbf_kernel.hpp"

namespace rehearse::moments {
namespace {

constexpr double kAddedVariance = 1e-6;  // of each action, before the squash (PILCO)

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vector clamped(const ConstVectorView& log_lengths) {
  return log_lengths.cwiseMax(-policy::kLargestLogLength).cwiseMin(policy::kLargestLogLength);
}

/// (L Lᵀ)⁻¹ y
Vector solve(const std::vector<double>& tiles, const ConstVectorView& y) {
  const Index n = y.size();
  Vector x = Vector::Zero(padded(n));
  x.head(n) = y;
  tiles_solve(n, tiles.data(), x.data());
  tiles_solve_transposed(n, tiles.data(), x.data());
  return x.head(n);
}

}  // namespace

RbfPolicy::RbfPolicy(const policy::RbfOptions& options, const ConstVectorView& theta)
    : PolicyMoments(options.features.features(), options.bounds),
      centres_(options.centres),
      theta_(theta),
      scale_(options.scale) {
  const Index size = features() * actions() + centres_ * (features() + actions());
  if (theta.size() != size)
    throw InvalidInput(fmt::format("policy: θ has {} numbers, must have {}", theta.size(), size));
  if (!theta.allFinite()) return;
  unscaled_ = theta.segment(centres_at(), centres_ * features()).reshaped(features(), centres_).transpose();
  std::vector<double> scaled(at(padded(centres_) * features()));
  std::vector<MomentTerm> terms;
  for (Index a = 0; a < actions(); ++a) {
    const Vector log_lengths = clamped(theta.segment(lengths_at(a), features()));
    inverse_lengths_.push_back((-log_lengths).array().exp());
    factors_.emplace_back(at(tiles_size(centres_)));
    gp::scale_inputs(unscaled_.data(), centres_, features(), inverse_lengths_.back().data(), scaled.data());
    const double jitter =
        gp::factorise({scaled.data(), centres_, features(), options.noise * options.noise}, factors_.back().data());
    if (std::isnan(jitter)) return;
    terms.push_back({.output = a,
                     .centres = unscaled_ * scale_.asDiagonal(),
                     .log_lengths = log_lengths.array() + scale_.array().log(),
                     .weights = solve(factors_.back(), theta.segment(targets_at(a), centres_)),
                     .variance = kAddedVariance});
    if (!terms.back().weights.allFinite() || !terms.back().centres.allFinite()) return;
  }
  network_.emplace(std::move(terms), actions(), true);
  ok_ = true;
}

bool RbfPolicy::forward_before(const Gaussian& features, PolicyTape& tape, const Evaluator& evaluator) const {
  return network_->forward(features, tape.network, tape.before, evaluator);
}

void RbfPolicy::adjoint_before(const Gaussian& features, const PolicyTape& tape, const Transformed& adjoint,
                               Gaussian& features_adjoint, PolicyAdjoint& policy) const {
  network_->adjoint(features, tape.network, tape.before, adjoint, features_adjoint, &policy.networks);
}

/// With ȳ = K⁻¹ w̄, the adjoint of K is −ȳ wᵀ. In coordinates s = c/ℓ, and with P_ij = (ȳ_i w_j + w_i ȳ_j) c(s_i, s_j)
/// and T = diag(P 1) S − P S: that of the centres T/ℓ, that of ln ℓ_d −Σ_i S_id T_id.
void RbfPolicy::add_covariance_gradient(Index action, const Vector& by_targets, Matrix& centres,
                                        Vector& log_lengths) const {
  const Matrix S = unscaled_ * inverse_lengths_[at(action)].asDiagonal();
  const Vector& weights = network_->terms()[at(action)].weights;
  Matrix P = gp::correlations(S, S);
  P.array() *= (by_targets * weights.transpose() + weights * by_targets.transpose()).array();
  const Matrix T = P.rowwise().sum().asDiagonal() * S - P * S;
  centres += T * inverse_lengths_[at(action)].asDiagonal();
  log_lengths -= S.cwiseProduct(T).colwise().sum().transpose();
}

Vector RbfPolicy::gradient(const PolicyAdjoint& adjoint) const {
  Vector gradient(theta_.size());
  Matrix centres = Matrix::Zero(centres_, features());
  for (Index a = 0; a < actions(); ++a) {
    const TermAdjoint& network = adjoint.networks[at(a)];
    const Vector by_targets = solve(factors_[at(a)], network.weights);
    Vector log_lengths = network.log_lengths;
    centres += network.centres * scale_.asDiagonal();
    add_covariance_gradient(a, by_targets, centres, log_lengths);
    const auto given = theta_.segment(lengths_at(a), features()).array();
    gradient.segment(lengths_at(a), features()) =
        (given.abs() < policy::kLargestLogLength).select(log_lengths.array(), 0);
    gradient.segment(targets_at(a), centres_) = by_targets;
  }
  gradient.segment(centres_at(), centres_ * features()) = centres.transpose().reshaped();
  return gradient;
}

}  // namespace rehearse::moments
