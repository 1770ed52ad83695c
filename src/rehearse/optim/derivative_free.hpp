#pragma once
// A local maximiser of a function without gradient, for the parameters of a simulator.

#include <functional>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// A value that is not finite marks x as infeasible.
using ScalarObjective = std::function<double(const Vector& x)>;

struct ScalarResult {
  Vector x;  // the best point seen, inside the box
  double value;
  Index evaluations;
  std::string stop;
};

/// Subplex (Rowan 1990) of NLopt, within a box.
struct SubplexOptions {
  Index max_evaluations = 1000;   // the authors' code
  double x_tolerance = 1e-4;      // relative
  double value_tolerance = 1e-4;  // relative
  double first_step = 0.1;        // as a fraction of the box's width
  bool repeat = false;            // begin again at the result until that improves it by less than value_tolerance: in a
                                  // curved valley one search stops early
  void fields(FieldVisitor& v) {
    v.integer("max_evaluations", max_evaluations, "evaluations at most", between(1, 2147483647));  // an int
    v.number("x_tolerance", x_tolerance, expert("stop when steps are smaller, relative to the point"), at_least(0));
    v.number("value_tolerance", value_tolerance, expert("stop when values differ by less, as a fraction"), at_least(0));
    v.number("first_step", first_step, expert("first step, as a fraction of the bounds' width"), between(1e-6, 1));
    v.boolean("repeat", repeat, expert("restart at the result until it no longer improves"));
  }
};
ScalarResult maximise_subplex(const ScalarObjective& objective, const Vector& start, const std::vector<Interval>& box,
                              const SubplexOptions& options);

/// Every combination of the choices, the last varying fastest.
std::vector<Vector> combinations(const std::vector<std::vector<double>>& choices);

}  // namespace rehearse::optim
