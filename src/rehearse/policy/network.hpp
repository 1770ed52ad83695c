#pragma once

#include <memory>

#include "rehearse/core/feature_map.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/policy/squash.hpp"

namespace rehearse::policy {

/// A perceptron with one hidden layer of tanh units (Chatzilygeroudis 2017, eq. 12). Inputs are the features divided
/// by `scale`. θ: for each hidden unit its weights and bias, then for each output its weights and bias.
struct MlpOptions {
  FeatureMap features;
  Vector scale;  // one a feature
  Index hidden = 10;
  Squash squash;
};
std::shared_ptr<const Policy> make_mlp(MlpOptions options);

/// u = squash(W features/scale + b). θ: for each action its weights and bias. The moments of u are known where the
/// squash is a sine (Deisenroth 2010, section 3.5).
struct LinearOptions {
  FeatureMap features;
  Vector scale;
  Squash squash;
};

/// The class that `make_linear` makes, with access to its options (moments/analytic_policy.hpp).
class Linear : public Policy {
 public:
  virtual const LinearOptions& options() const = 0;
};

std::shared_ptr<const Policy> make_linear(const LinearOptions& options);

}  // namespace rehearse::policy
