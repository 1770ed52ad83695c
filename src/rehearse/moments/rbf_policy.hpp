#pragma once

#include <optional>
#include <vector>

#include "rehearse/moments/policy_moments.hpp"
#include "rehearse/policy/rbf.hpp"

namespace rehearse::moments {

/// The moments of a policy of policy::make_rbf: of the mean of a GP with σ_f = 1 (Deisenroth 2010, section 3.5),
/// squashed. PILCO adds 1e-6 to the variance of each action before the squash.
class RbfPolicy final : public PolicyMoments {
 public:
  /// theta: in the order that policy/rbf.hpp says. Throws InvalidInput if it has another size.
  RbfPolicy(const policy::RbfOptions& options, const ConstVectorView& theta);

  bool ok() const override { return ok_; }
  PolicyAdjoint zero_adjoints() const override { return {.networks = network_->zero_adjoints()}; }

  /// The weights of a network are (K + σ_n² I)⁻¹ y.
  Vector gradient(const PolicyAdjoint& adjoint) const override;

 private:
  bool forward_before(const Gaussian& features, PolicyTape& tape, const Evaluator& evaluator) const override;
  void adjoint_before(const Gaussian& features, const PolicyTape& tape, const Transformed& adjoint,
                      Gaussian& features_adjoint, PolicyAdjoint& policy) const override;
  Index lengths_at(Index action) const { return action * features(); }
  Index centres_at() const { return actions() * features(); }
  Index targets_at(Index action) const { return centres_at() + centres_ * features() + action * centres_; }
  void add_covariance_gradient(Index action, const Vector& by_targets, Matrix& centres, Vector& log_lengths) const;

  Index centres_;
  Vector theta_, scale_;
  Matrix unscaled_;                           // centres as θ has them, centres × inputs
  std::vector<Vector> inverse_lengths_;       // an action
  std::vector<std::vector<double>> factors_;  // an action: the Cholesky factor of K + σ_n² I in tiles
  std::optional<MomentMatching> network_;
  bool ok_ = false;
};

}  // namespace rehearse::moments
