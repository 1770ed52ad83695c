#pragma once

#include <vector>

#include "rehearse/moments/gaussian.hpp"

namespace rehearse::moments {

/// amplitude · sin(frequency · x_input + phase), a summand of an output.
struct Sine {
  Index output = 0;
  Index input = 0;
  double amplitude = 1, frequency = 1, phase = 0;
};

/// The exact moments of sums of sines of a Gaussian x (Deisenroth 2010, appendix A.1: E[sin], E[sin sin]): of the
/// features of angles (PILCO's gTrig, gSin) and of the squash of PILCO's policies (gSat). Any thread.
Transformed sine_moments(const std::vector<Sine>& sines, Index outputs, const Gaussian& x);

/// Adds to the adjoint of x what the adjoint of the result brings.
void sine_adjoint(const std::vector<Sine>& sines, const Gaussian& x, const Transformed& adjoint, Gaussian& x_adjoint);

}  // namespace rehearse::moments
