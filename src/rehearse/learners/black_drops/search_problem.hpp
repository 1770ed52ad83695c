#pragma once

#include <memory>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/learners/black_drops/gradient_options.hpp"
#include "rehearse/learners/black_drops/safety.hpp"
#include "rehearse/optim/race.hpp"
#include "rehearse/optim/restarts.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::learners::black_drops {

enum class Method {
  race,      // many descents that compete: on the pendubot's true dynamics it finds a solution with far fewer rollouts
  restarts,  // one after the other, the paper's: BIPOP, with uncertainty handling and elitism if asked for
  gradient,  // by the gradient through the model (Amadio 2022); the race where limits are what is looked for
  polish,    // the race, from whose best policies descents by gradient begin
};

/// True if a method needs the derivatives of the policy (policy::Differentiable).
inline bool needs_derivatives(Method method) { return method == Method::gradient || method == Method::polish; }

/// Each rollout is one noisy measurement of the expected return, which CMA-ES maximises (Chatzilygeroudis 2017).
struct SearchOptions {
  Method method = Method::race;
  double box = 5;          // θ in [−box, box] unless the policy has a box of its own; the authors' code
  Index particles = 1;     // rollouts of one evaluation; the paper: 1
  double extra_s = 0;      // by which simulated episodes are longer than a trial
  bool hand_over = false;  // near a goal in which the robot can stay, policies hand over to linear feedback
  rollout::SimulateOptions simulate;
  optim::RaceOptions race;
  optim::SearchOptions restarts{.max_evaluations = 200000};
  GradientOptions gradient;
  Index finalists = 4;    // best policies found that are compared once more, together with those it started from
  Index selection = 100;  // rollouts of each of them, if they can differ; their mean is the predicted return
  SafetyOptions safety;
  bool constrained = false;  // not an option: descents, too, put policies that keep the task's limits above all others
  void fields(FieldVisitor& v);
};

/// The problem of a search. References must outlive it.
struct SearchProblem {
  const dynamics::DynamicsModel& model;
  const policy::Policy& policy;
  const Task& task;
  const Evaluator& evaluator;
  const ProgressSink& progress;
  std::vector<std::shared_ptr<const dynamics::DynamicsModel>> doubted = {};  // if any, episodes use these in turn
                                                                             // instead
};

/// The same problem of another task.
SearchProblem with_task(const SearchProblem& problem, const Task& task);

/// The task whose episodes go on so many seconds after their end. An episode solves it if its first steps and its last
/// steps, as many as the task has, do.
Task continued(Task task, double extra_s);

/// Rollouts by which a policy is compared with others: `selection`, or 1 where model, start and measurements are
/// certain; of a task with limits at least `safety.rollouts`.
Index comparisons(const SearchProblem& problem, const SearchOptions& options);

}  // namespace rehearse::learners::black_drops
