#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "rehearse/core/feature_map.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// A network of radial basis functions, the mean of a GP with σ_f = 1 conditioned on pseudo-observations (Deisenroth
/// 2010, eqs 3.15 and 3.46: "GP policy"), squashed by (9 sin a + sin 3a)/8:
///
///   a = k(x)ᵀ (K + σ_n² I)⁻¹ y,   k_i(x) = exp(−½ Σ_d (x_d − c_id)² / ℓ_d²)
///
/// Inputs x are the features divided by `scale`. θ: for each action ln ℓ (D), then the centres c, one after the other
/// (m × D, shared by the actions), then for each action its targets y (m).
struct RbfOptions {
  FeatureMap features;
  Vector scale;                  // one a feature
  Index centres = 10;            // m; PILCO and the authors: 10 for the cart-pole, PILCO 200 for the pendubot
  double noise = 0.01;           // σ_n; PILCO and the authors
  std::vector<Interval> bounds;  // one an action
};

/// The class that `make_rbf` makes, with access to its options (moments/analytic_policy.hpp).
class Rbf : public Policy {
 public:
  const RbfOptions& options() const { return options_; }

 protected:
  explicit Rbf(RbfOptions options) : options_(std::move(options)) {}
  const RbfOptions options_;
};

std::shared_ptr<const Policy> make_rbf(RbfOptions options);

}  // namespace rehearse::policy
