#include <algorithm>
#include <cmath>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/box.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::optim {
namespace {

void check(const Vector& start, const RpropOptions& options) {
  Violations violations;
  violations.add(field_violations("rprop", options));
  violations.add(start_violations(start, {}));
  violations.throw_if_any();
}

double sign(double x) { return static_cast<double>((x > 0) - (x < 0)); }

/// The state of a search: where the last finite value was, its gradient and the step of each coordinate.
struct Rprop {
  const RpropOptions& options;
  Vector x, gradient, steps;

  void move(const Vector& next_x, Vector next_gradient) {  // Igel and Hüsken 2003, Table 1 (iRprop−), for a maximum
    for (Index i = 0; i < x.size(); ++i) {
      const double agreement = next_gradient(i) * gradient(i);
      if (agreement > 0) steps(i) = std::min(1.2 * steps(i), options.largest_step);
      if (agreement < 0) steps(i) = std::max(0.5 * steps(i), options.smallest_step);
      if (agreement < 0) next_gradient(i) = 0;
    }
    x = next_x;
    gradient = next_gradient;
  }

  void retreat() { steps = (0.5 * steps).cwiseMax(options.smallest_step); }
  bool vanished() const { return (steps.array() <= options.smallest_step).all(); }
  Vector next() const { return x + steps.cwiseProduct(gradient.unaryExpr(&sign)); }
};

}  // namespace

GradientResult maximise_rprop(const Differentiable& objective, const Vector& start, const RpropOptions& options) {
  check(start, options);
  const Index n = start.size();
  GradientResult best{start, kNaN, 0, "max_evaluations"};
  Rprop search{options, start, Vector::Zero(n), Vector::Constant(n, options.first_step)};
  Vector x = start, gradient = Vector::Zero(n);
  while (best.evaluations < options.max_evaluations) {
    const double value = objective(x, gradient);
    ++best.evaluations;
    const bool feasible = std::isfinite(value) && gradient.allFinite();
    if (!feasible && !std::isfinite(best.value)) {
      best.stop = "no finite value";
      break;
    }
    if (feasible && !(value <= best.value)) {
      best.x = x;
      best.value = value;
    }
    if (feasible)
      search.move(x, gradient);
    else
      search.retreat();
    if (search.vanished() || (feasible && gradient.norm() < options.gradient_tolerance)) {
      best.stop = "converged";
      break;
    }
    x = search.next();
  }
  return best;
}

}  // namespace rehearse::optim
