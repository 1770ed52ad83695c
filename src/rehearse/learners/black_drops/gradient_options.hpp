#pragma once

#include "rehearse/core/options.hpp"
#include "rehearse/optim/adam.hpp"

namespace rehearse::learners::black_drops {

/// Descents by gradient through simulated episodes (Amadio 2022), of which after each round the better half goes on.
struct GradientOptions {
  Index steps = 1000;    // of a descent that goes on to the end
  Index particles = 64;  // rollouts of a step, shared by the descents that are left
  Index descents = 8;    // that start
  Index rounds = 4;      // of about equal numbers of steps
  double start = 0.2;    // random ones start in so much of the box, about its middle: where tanh is steep
  double dropout = 0;    // weights of units that a step leaves out at first; three quarters through the search it is 0
  optim::AdamOptions adam;
  void fields(FieldVisitor& v);
};

}  // namespace rehearse::learners::black_drops
