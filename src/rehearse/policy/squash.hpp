#pragma once

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::policy {

/// Keeps actions inside their bounds: centre + half width · tanh(gain · a).
struct Squash {
  std::vector<Interval> bounds;  // one an action
  double gain = 1;               // the paper: 1; the authors' code: 5 on the pendubot

  /// a: n × actions, replaced by the squashed actions.
  void apply(MatrixView a) const;
};

}  // namespace rehearse::policy
