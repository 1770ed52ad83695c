#pragma once

#include <vector>

#include "rehearse/moments/sine_moments.hpp"

namespace rehearse::moments {

/// The moments of PILCO's squash, centre + half width · (9 sin a + sin 3a)/8 for each action (Deisenroth 2010,
/// section 3.5), which keeps actions inside their bounds. Immutable; any thread.
class SquashMoments {
 public:
  explicit SquashMoments(const std::vector<Interval>& bounds);

  /// a: the actions before the squash, one a bound. The gain of the result is diagonal.
  Transformed operator()(const Gaussian& a) const;

  /// Adds to the adjoint of `a` what the adjoint of the result brings.
  void adjoint(const Gaussian& a, const Transformed& adjoint, Gaussian& a_adjoint) const {
    sine_adjoint(sines_, a, adjoint, a_adjoint);
  }

 private:
  std::vector<Sine> sines_;
  Vector centre_;
};

}  // namespace rehearse::moments
