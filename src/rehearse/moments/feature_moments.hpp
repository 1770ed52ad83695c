#pragma once

#include "rehearse/core/feature_map.hpp"
#include "rehearse/moments/sine_moments.hpp"

namespace rehearse::moments {

/// The exact moments of the features of a Gaussian state: cosines and sines of its angles, other states as they are
/// (Deisenroth 2010, appendix A.1). A joint's angle is a difference of two angles, which is Gaussian with them.
/// Immutable; any thread.
class FeatureMoments {
 public:
  explicit FeatureMoments(const FeatureMap& features);

  Index states() const { return angles_.cols(); }

  /// state: dx; the result has features.features() outputs. Throws InvalidInput if the state has another size.
  Transformed operator()(const Gaussian& state) const;

  /// Adds to the adjoint of the state what the adjoint of the result brings. `result`: of the same state.
  void adjoint(const Gaussian& state, const Transformed& result, const Transformed& adjoint,
               Gaussian& state_adjoint) const;

 private:
  struct Plain {
    Index output, input;
  };
  Gaussian angles(const Gaussian& state) const;

  std::vector<Plain> plain_;
  std::vector<Sine> sines_;  // of the states and, after them, the joints' angles
  Matrix angles_;            // both of a state, linear in it: (dx + joints) × dx
  Index outputs_;
};

}  // namespace rehearse::moments
