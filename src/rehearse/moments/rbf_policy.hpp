#pragma once

#include <optional>
#include <vector>

#include "rehearse/gp/moment_matching.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/policy/squash_moments.hpp"

namespace rehearse::moments {

/// What the adjoint needs of the forward pass; reused without allocation of what grows with the centres.
struct PolicyTape {
  gp::MomentTape network;
  Transformed before;  // the squash
  Transformed squash;
};

/// The moments of a policy of policy::make_rbf at θ, where its features are Gaussian: of the mean of a GP with σ_f = 1
/// (Deisenroth 2010, section 3.5), squashed. PILCO adds 1e-6 to the variance of each action before the squash.
/// Immutable; any thread.
class RbfPolicy {
 public:
  /// theta: in the order that policy/rbf.hpp says. Throws InvalidInput if it has another size.
  RbfPolicy(const policy::RbfOptions& options, const ConstVectorView& theta, double jitter = 1e-6);

  /// False: θ is not finite, or so extreme that its weights cannot be computed; nothing else may be called then.
  bool ok() const { return ok_; }

  /// False if there are no moments, as in gp/moment_matching.hpp.
  bool forward(const Gaussian& features, PolicyTape& tape, Transformed& action, const Evaluator& evaluator) const;

  /// Adds to the adjoints of the features and of the networks what the adjoint of the action brings.
  void adjoint(const Gaussian& features, const PolicyTape& tape, const Transformed& adjoint, Gaussian& features_adjoint,
               std::vector<gp::TermAdjoint>& networks) const;
  std::vector<gp::TermAdjoint> zero_adjoints() const { return network_->zero_adjoints(); }

  /// The gradient by θ, once for the sum of the adjoints of all steps: the weights of a network are (K + σ_n² I)⁻¹ y.
  Vector gradient(const std::vector<gp::TermAdjoint>& networks) const;

 private:
  Index lengths_at(Index action) const { return action * inputs_; }
  Index centres_at() const { return actions_ * inputs_; }
  Index targets_at(Index action) const { return centres_at() + centres_ * inputs_ + action * centres_; }
  void add_covariance_gradient(Index action, const Vector& by_targets, Matrix& centres, Vector& log_lengths) const;

  Index inputs_, centres_, actions_;
  Vector theta_, scale_;
  Matrix unscaled_;                           // centres as θ has them, centres × inputs
  std::vector<Vector> inverse_lengths_;       // an action
  std::vector<std::vector<double>> factors_;  // an action: the Cholesky factor of K + σ_n² I in tiles
  std::optional<gp::MomentMatching> network_;
  policy::SquashMoments squash_;
  bool ok_ = false;
};

}  // namespace rehearse::moments
