#pragma once
// A local minimiser of sums of squares.

#include <functional>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// Errors r (m) that depend on x (n), and their derivatives (m × n) at x, where they are r. An r that is not finite
/// marks x as infeasible.
struct SquaresProblem {
  std::function<Vector(const Vector& x)> errors;
  std::function<Matrix(const Vector& x, const Vector& r)> derivatives;
  Vector low, high;           // n, of the box; where both are the same, x stays
  double negligible = 1e-20;  // a sum of squares that is as good as 0
};

struct SquaresOptions {
  Index max_steps = 60;      // each takes the derivatives once
  double tolerance = 1e-12;  // of the sum of squares: a step that promises less ends the search
};

struct SquaresResult {
  Vector x;           // the best point seen, inside the box
  double value;       // ‖r‖² there; infinite if it is not feasible
  Index evaluations;  // of the errors, without those for derivatives
  bool converged;     // no step promises more. False: max_steps, or derivatives that mislead
};

/// Gauss–Newton with Levenberg's and Marquardt's damping (Moré 1978), each step the best one in the box. Along
/// directions that change nothing x stays at its start.
SquaresResult minimise_squares(const SquaresProblem& problem, const Vector& start, const SquaresOptions& options = {});

}  // namespace rehearse::optim
