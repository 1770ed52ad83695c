#pragma once
// Functions to maximise, with their gradients.

#include <cmath>

#include "rehearse/core/types.hpp"

namespace rehearse::optim::test {

inline double quadratic(const Vector& x, Vector& gradient) {  // maximum 3 at (1, …, 1)
  double value = 3;
  gradient.resize(x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const double scale = static_cast<double>(i + 1), d = x(i) - 1;
    value -= scale * d * d;
    gradient(i) = -2 * scale * d;
  }
  return value;
}

inline double rosenbrock(const Vector& x, Vector& gradient) {  // maximum 0 at (1, 1)
  const double a = x(1) - x(0) * x(0), b = 1 - x(0);
  gradient = Vector{{400 * x(0) * a + 2 * b, -200 * a}};
  return -100 * a * a - b * b;
}

inline double log_barrier(const Vector& x, Vector& gradient) {  // ln x − x, not finite below 0; maximum −1 at 1
  gradient = Vector{{1 / x(0) - 1}};
  return x(0) > 0 ? std::log(x(0)) - x(0) : kNaN;
}

}  // namespace rehearse::optim::test
