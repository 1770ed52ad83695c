#include "rehearse/policy/squash_slope.hpp"

#include "rehearse/core/vector_math.hpp"

namespace rehearse::policy {

void squash_slope(const Squash& squash, MatrixView a) {
  thread_local Vector sine;
  sine.resize(a.rows());
  for (Index c = 0; c < a.cols(); ++c) {
    const Interval& bound = squash.bounds[static_cast<std::size_t>(c)];
    const double factor = squash.gain * (bound.high - bound.low) / 2;
    auto column = a.col(c);
    column *= squash.gain;
    if (squash.shape == Squash::Shape::tanh) {
      vector_tanh(column.data(), column.data(), column.size());
      column = factor * (1 - column.array().square());
    } else {  // (9 cos a + 3 cos 3a)/8 = 3/2 cos³ a
      vector_sin_cos(column.data(), sine.data(), column.data(), column.size());
      column = 1.5 * factor * column.array().cube();
    }
  }
}

}  // namespace rehearse::policy
