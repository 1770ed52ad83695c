#pragma once

#include "rehearse/core/options.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// Adam (Kingma and Ba 2015, algorithm 1): steps along a gradient that is noisy, each coordinate by its own scale.
struct AdamOptions {
  double step = 0.01;         // of the first step, and the last; between them it falls geometrically
  double last_step = 0.0025;  // both Amadio 2022, which halves it where the return settles
  double mean_decay = 0.9;
  double square_decay = 0.999;
  double floor = 1e-8;  // added to the scale of a coordinate
  void fields(FieldVisitor& v) {
    v.number("step", step, "largest change of a parameter in the first step", above(0));
    v.number("last_step", last_step, "step size at the end; falls geometrically from `step`", above(0));
    v.number("mean_decay", mean_decay, "decay of the gradient's mean", between(0, 0.999999));
    v.number("square_decay", square_decay, "decay of the gradient's mean square", between(0, 0.999999));
    v.number("floor", floor, "added to the root of the mean square", above(0));
  }
};

/// The state of Adam for one point that it moves. A value.
class Adam {
 public:
  Adam(Index coordinates, const AdamOptions& options);

  /// Moves x uphill. `done`: the fraction of the search that is over, in [0, 1]. A gradient that is not finite is
  /// ignored.
  void ascend(VectorView x, const ConstVectorView& gradient, double done);

 private:
  AdamOptions options_;
  Vector mean_, square_;
  double mean_weight_ = 1, square_weight_ = 1;  // of what they began with
};

}  // namespace rehearse::optim
