#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::policy {

/// One layer for a batch in which every row has its own weights: out(r, o) = f(b(r, o) + Σ_i W(r, o, i) in(r, i)), f
/// being tanh or nothing. weights: n × outputs·(inputs + 1) with `weight_stride` between columns; in, out: n × inputs,
/// n × outputs.
void layer(const double* weights, Index weight_stride, const double* in, Index in_stride, Index inputs, double* out,
           Index out_stride, Index outputs, Index rows, bool tanh);

}  // namespace rehearse::policy
