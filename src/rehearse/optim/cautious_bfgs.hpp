#pragma once

#include "rehearse/optim/gradient.hpp"

namespace rehearse::optim {

/// BFGS as PILCO searches policies with (Rasmussen's minimize.m, 2013): a line search begins no longer than the last
/// one ended, and never longer than 1; it ends where the slope is at most half as steep; and a small promise is no
/// reason to stop. Slower than maximise_bfgs on smooth functions; where steps must not leave a valley it finds higher
/// maxima.
struct CautiousBfgsOptions {
  Index line_searches = 150;    // PILCO
  Index line_evaluations = 30;  // at most, of a line search; PILCO
  double longest_step = 1;      // ‖Δx‖ that a line search begins with at most; Rasmussen
  double slope = 0.5;           // Wolfe's: how steep a line search may end; Rasmussen
  Index patience = 0;           // line searches that have to gain `patience_gain` of the value together; 0: none
  double patience_gain = 0.01;
  void fields(FieldVisitor& v) {
    v.integer("line_searches", line_searches, "line searches at most", at_least(1));
    v.integer("line_evaluations", line_evaluations, expert("evaluations at most, of a line search"), at_least(1));
    v.number("longest_step", longest_step, expert("length of the step that a line search begins with at most"),
             above(0));
    v.number("slope", slope, expert("curvature constant of the Wolfe conditions"), between(1e-3, 0.99));
    v.integer("patience", patience,
              "a search stops if this many line searches together improve by less than patience_gain; 0: never",
              at_least(0));
    v.number("patience_gain", patience_gain,
             "smallest improvement by `patience` line searches, as a fraction of the value", between(0, 1));
  }
};

/// Stops after "line_searches", out of "patience", as "converged" (no line search succeeds, not even along the
/// gradient), or with "no finite value". No matrix of the coordinates: some 1000 of them are fine.
GradientResult maximise_cautious_bfgs(const Differentiable& objective, const Vector& start,
                                      const CautiousBfgsOptions& options);

}  // namespace rehearse::optim
