#include "rehearse/policy/squash.hpp"

#include "rehearse/core/vector_math.hpp"

namespace rehearse::policy {

void Squash::apply(MatrixView a) const {
  for (Index c = 0; c < a.cols(); ++c) {
    const Interval& bound = bounds[static_cast<std::size_t>(c)];
    auto column = a.col(c);
    column *= gain;
    (shape == Shape::tanh ? vector_tanh : vector_sine_squash)(column.data(), column.data(), column.size());
    column = (bound.low + bound.high) / 2 + (bound.high - bound.low) / 2 * column.array();
    // Rounding may leave the bounds by the last bit; a NaN stays.
    for (double& u : column) u = u > bound.high ? bound.high : u < bound.low ? bound.low : u;
  }
}

}  // namespace rehearse::policy
