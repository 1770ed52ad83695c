#pragma once
// Local maximisers that use a gradient.

#include <functional>
#include <string>

#include "rehearse/core/options.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// Value at x, and its gradient (same size as x). A value that is not finite marks x as infeasible.
using Differentiable = std::function<double(const Vector& x, Vector& gradient)>;

struct GradientResult {
  Vector x;      // the best point that was accepted
  double value;  // there; not finite only if no point had a finite value
  Index evaluations;
  std::string stop;  // why: "converged", "max_evaluations", "no finite value"
};

/// Rprop with the improvements iRprop− (Igel and Hüsken 2003), the paper's kernel fit.
struct RpropOptions {
  Index max_evaluations = 300;  // the authors' code
  double gradient_tolerance = 1e-4;
  double first_step = 0.1;
  double smallest_step = 1e-6;
  double largest_step = 50;
  void fields(FieldVisitor& v) {
    v.integer("max_evaluations", max_evaluations, "evaluations at most", at_least(1));
    v.number("gradient_tolerance", gradient_tolerance, "stop when the gradient is smaller", at_least(0));
    v.number("first_step", first_step, "step that the search begins with", above(0));
    v.number("smallest_step", smallest_step, "step at least", above(0));
    v.number("largest_step", largest_step, "step at most", above(0));
    v.require(smallest_step <= first_step && first_step <= largest_step,
              "first_step = " + to_text(first_step) + ", must be between smallest_step = " + to_text(smallest_step) +
                  " and largest_step = " + to_text(largest_step));
  }
};
GradientResult maximise_rprop(const Differentiable& objective, const Vector& start, const RpropOptions& options);

/// BFGS with a dense matrix (Nocedal and Wright 2006, algorithm 6.1), for up to some 100 coordinates.
struct BfgsOptions {
  Index max_evaluations = 200;
  double relative_tolerance = 1e-8;  // of the value: what the next step promises to gain
  void fields(FieldVisitor& v) {
    v.integer("max_evaluations", max_evaluations, "evaluations at most", at_least(1));
    v.number("relative_tolerance", relative_tolerance, "stop when the next step promises to gain less, as a fraction",
             at_least(0));
  }
};

/// `inverse_hessian`, unless null, is that of the negative objective: where it is n × n the search begins with it, and
/// it ends with what was learned of it. A search for nearly the same maximum needs a quarter of the evaluations with
/// it.
GradientResult maximise_bfgs(const Differentiable& objective, const Vector& start, const BfgsOptions& options,
                             Matrix* inverse_hessian = nullptr);

}  // namespace rehearse::optim
