#include "rehearse/testing/check_gradient.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/testing/compare.hpp"

namespace rehearse::testing {
namespace {

double slope(const optim::Differentiable& function, const Vector& x, Index i, double h) {
  Vector at = x, unused(x.size());
  at(i) = x(i) + h;
  const double above = function(at, unused);
  at(i) = x(i) - h;
  return (above - function(at, unused)) / (2 * h);
}

}  // namespace

std::vector<std::string> check_gradient(const optim::Differentiable& function, const Vector& x, double tolerance,
                                        double step) {
  Violations found;
  Vector gradient = Vector::Zero(x.size()), again = Vector::Constant(x.size(), 7);
  const double value = function(x, gradient);
  for (Index i = 0; i < x.size(); ++i) {
    const double h = step * std::max(1.0, std::abs(x(i)));
    const double expected = (4 * slope(function, x, i, h / 2) - slope(function, x, i, h)) / 3;  // Richardson 1911
    const double error = std::abs(gradient(i) - expected);
    if (!(error <= tolerance * std::max(1.0, std::abs(expected))))
      found.add(fmt::format("gradient[{}] = {}, must be {} by central differences", i, gradient(i), expected));
  }
  if (!same(function(x, again), value) || !same(again, gradient)) found.add("the same call gives another answer later");
  return found.list();
}

}  // namespace rehearse::testing
