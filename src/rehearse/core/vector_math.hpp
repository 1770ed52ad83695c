#pragma once
// Elementary functions over contiguous doubles, vectorised by Highway for the processor found at run time.
// All may run concurrently; `out` may be `in`. A NaN comes back as NaN.

#include "rehearse/core/types.hpp"

namespace rehearse {

void vector_exp(const double* in, double* out, Index n);
void vector_tanh(const double* in, double* out, Index n);
/// Sine and cosine of any finite angle, within 1e-15; NaN for others.
void vector_sin_cos(const double* in, double* sine, double* cosine, Index n);

/// (9 sin a + sin 3a)/8, in [−1, 1] (Deisenroth 2010, eq. 3.46). Beyond ± 10⁴ rad, where it has no meaning, as there.
void vector_sine_squash(const double* in, double* out, Index n);

/// Two independent N(0, 1) from two uniforms in [0, 1) (Box and Muller 1958); `second` may be null.
void box_muller(const double* uniform1, const double* uniform2, double* first, double* second, Index n);

}  // namespace rehearse
