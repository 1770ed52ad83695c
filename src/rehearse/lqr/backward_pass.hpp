#pragma once

#include <optional>
#include <vector>

#include "rehearse/lqr/step_costs.hpp"

namespace rehearse::lqr {

/// A step about its state y and its actions u, in units of half their range: the next state, and its variances.
struct LinearStep {
  Matrix by;           // n × (n + du), the next state by y, then u
  Vector variance;     // n, of the next state
  Matrix variance_by;  // n × (n + du)
};

/// A step as the planner sees it.
struct PlannedStep {
  LinearStep dynamics;
  Expansion cost;
  Vector action;  // du, in units of half the range from its middle: within ±1
};

/// The cost to go ½ dᵀSd + sᵀd of a state that is d away from the planned one.
struct Value {
  Vector s;
  Matrix S;
};

/// A step's feedback changes the actions by `open` + `gain` · d.
struct Feedback {
  Vector open;  // du
  Matrix gain;  // du × n
};

struct BackwardPass {
  std::vector<Feedback> feedback;  // of each step
  std::vector<Value> values;       // of the state before each step, and at the end
};

/// The curvature of all costs by entry i of the state that a step leads to: of those that follow, and of the step's own
/// by the state reached.
double curvature_at_next(const PlannedStep& step, const Value& after, Index i);

/// One step of dynamic programming (Lee 2017; Li 2004): the best feedback within bounds of the actions (Tassa 2014),
/// and the cost to go before it, `before`. damping: added to the curvature by the actions. Where `uncertainty` is 1
/// the model's variance V of a state costs half tr(S V), S the curvature of all costs by that state (Lee's rewards are
/// of the state before a step, so that his S of the next state has them, too); 0: nothing. nullopt where the curvature
/// is not positive.
struct BackwardStep {
  Feedback feedback;
  Value before;
};
std::optional<BackwardStep> backward_step(const PlannedStep& step, const Value& after, double damping,
                                          double uncertainty);

/// The feedback and the cost to go of a step that is repeated for ever: the discrete Riccati equation, solved by its
/// recursion. nullopt where it does not settle, since no feedback makes the system stable.
std::optional<BackwardStep> repeated_step(const PlannedStep& step);

/// All steps from the last to the first.
std::optional<BackwardPass> backward_pass(const std::vector<PlannedStep>& steps, const Value& end, double damping,
                                          double uncertainty);

}  // namespace rehearse::lqr
