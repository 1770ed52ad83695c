#pragma once

#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"

namespace rehearse::lqr {

/// The cost that the planner, which minimises a sum of them, makes of a reward.
enum class CostScale {
  linear,       // minus the reward
  logarithmic,  // minus its logarithm: a saturating reward is flat nearly everywhere, its logarithm nowhere
};

struct CostOptions {
  CostScale scale = CostScale::linear;
  double action_cost = 1e-3;  // of an action at its bound, beside the reward
  double task_costs = 1;      // weight of the task's costs of steps
};

/// Steps of a batch in columns: the state x, the actions u one step before (of a task with a cost of steps alone), the
/// actions u, and the state reached.
struct Columns {
  Index dx = 0, before = 0, du = 0;

  explicit Columns(const Task& task)
      : dx(task.state_size()), before(task.cost ? task.action_size() : 0), du(task.action_size()) {}

  Index all() const { return 2 * dx + before + du; }
  Index planner_state() const { return dx + before; }  // what the planner's feedback could depend on
  Index action() const { return dx + before; }         // the first column of the actions
  Index reached() const { return dx + before + du; }   // and of the state reached
};

/// A cost about a step: value, gradient and a Hessian without its negative curvature, by the columns of the step.
/// Actions are in units of half their range.
struct Expansion {
  double value = 0;
  Vector gradient;
  Matrix hessian;
};

/// Costs of single steps. Any thread.
class StepCosts {
 public:
  /// The task must outlive it.
  StepCosts(const Task& task, const CostOptions& options);

  const Columns& columns() const { return columns_; }
  const Vector& half_ranges() const { return half_; }  // du

  Vector in_half_ranges(const ConstVectorView& actions) const { return (actions - middle_).cwiseQuotient(half_); }

  /// The cost of each step that an early end leaves out.
  double of_floor() const;

  /// W: one step a row; times_s: when each begins. A cost that is not finite is infinite.
  void evaluate(const ConstMatrixView& W, const Vector& times_s, VectorView costs) const;

  /// The cost of a step that begins at a time and stays in its state (rows × dx) under an action (rows × du), which was
  /// also the action before.
  Vector of_staying(const ConstMatrixView& states, const ConstMatrixView& actions, double time_s) const;

  /// By finite differences, all steps in one batch.
  std::vector<Expansion> expand(const ConstMatrixView& W, const Vector& times_s) const;

 private:
  void add_step_costs(const ConstMatrixView& W, const Vector& times_s, VectorView costs) const;

  const Task& task_;
  Columns columns_;
  CostOptions options_;
  Vector middle_, half_;
};

}  // namespace rehearse::lqr
