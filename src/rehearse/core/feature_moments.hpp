#pragma once

#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/sine_moments.hpp"

namespace rehearse {

/// The exact moments of the features of a Gaussian state: cosines and sines of its angles, other states as they are
/// (Deisenroth 2010, appendix A.1). Immutable; any thread.
class FeatureMoments {
 public:
  /// Throws InvalidInput if there are joint angles: their moments are not implemented.
  explicit FeatureMoments(const FeatureMap& features);

  /// state: dx; the result has features.features() outputs.
  Transformed operator()(const Gaussian& state) const;

  /// Adds to the adjoint of the state what the adjoint of the result brings. `result`: of the same state.
  void adjoint(const Gaussian& state, const Transformed& result, const Transformed& adjoint,
               Gaussian& state_adjoint) const;

 private:
  struct Plain {
    Index output, input;
  };
  std::vector<Plain> plain_;
  std::vector<Sine> sines_;
  Index outputs_;
};

}  // namespace rehearse
