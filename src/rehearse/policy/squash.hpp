#pragma once

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::policy {

/// Keeps actions inside their bounds: centre + half width · f(gain · a).
struct Squash {
  enum class Shape {
    tanh,
    sine,  // (9 sin a + sin 3a)/8, which has analytic moments (Deisenroth 2010, eq. 3.46)
  };
  std::vector<Interval> bounds;  // one an action
  double gain = 1;               // the paper: 1; the authors' code: 5 on the pendubot
  Shape shape = Shape::tanh;

  /// a: n × actions, replaced by the squashed actions.
  void apply(MatrixView a) const;
};

}  // namespace rehearse::policy
