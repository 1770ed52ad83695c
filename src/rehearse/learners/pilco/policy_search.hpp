#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/moments/gaussian.hpp"
#include "rehearse/moments/step_dynamics.hpp"
#include "rehearse/optim/cautious_bfgs.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::learners::pilco {

struct SearchOptions {
  optim::CautiousBfgsOptions bfgs{.patience = 20, .patience_gain = 0.001};  // PILCO: none
  // The least deviation of each state of the start that policies are made for. It smooths the objective (PILCO's
  // cart-pole: 0.1), but may promise a return that a robot with an exact start never earns.
  double start_std = 0;
  // The number of first policies that are starts of searches, too, while the last trial has not solved the task; the
  // best result is taken, since searches by gradient stay at local optima. PILCO: none.
  Index restarts = 2;
  void fields(FieldVisitor& v);
};

struct SearchResult {
  Vector theta;
  std::optional<double> predicted_return;  // empty: no policy had one, theta is the start
  Index evaluations = 0;                   // of the expected return, in all searches
  Index failed = 0;                        // of these, without a value
};

/// References must outlive the search.
struct SearchProblem {
  moments::StepDynamics dynamics;
  const policy::Policy& policy;  // analytic
  const Task& task;              // with a saturating reward
  const Evaluator& evaluator;
  const ProgressSink& progress;
};

/// N(the task's start, the larger of its deviations and the option's).
moments::Gaussian start_state(const Task& task, const SearchOptions& options);

/// Maximises the expected return from `start`. What the progress sink throws, passes.
SearchResult search_policy(const SearchProblem& problem, const Vector& start, const SearchOptions& options);

/// Other starts of a search.
struct Restarts {
  StreamKey key = {};                 // of first policies, those with the candidates 1, 2, …
  std::vector<Vector> policies = {};  // to be chosen from in their place, the best on the model; empty: first policies
};

/// The best of `search_policy` from `start` and from `SearchOptions::restarts` others. `earned`: what `start` earns,
/// where that is known. Where it promises more, the model is wrong about it, and the search from there promises less by
/// as much.
SearchResult search_with_restarts(const SearchProblem& problem, const Vector& start, const SearchOptions& options,
                                  const Restarts& restarts, std::optional<double> earned = {});

}  // namespace rehearse::learners::pilco
