#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/gaussian.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/gp/moment_matching.hpp"
#include "rehearse/optim/cautious_bfgs.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::learners::pilco {

struct SearchOptions {
  optim::CautiousBfgsOptions bfgs;
  // At least so uncertain is the start that policies are made for: a narrow one leaves little to learn from. PILCO: 0.1
  // of every state of the cart-pole, 0.01 of the pendubot's angles.
  double start_std = 0.1;        // of states that are no angles, in their units
  double start_std_angle = 0.1;  // rad
  void fields(FieldVisitor& v);
};

struct SearchResult {
  Vector theta;
  std::optional<double> predicted_return;  // empty: no policy had one, theta is the start
  Index evaluations = 0;                   // of the expected return
  Index failed = 0;                        // of these, without a value
};

/// References must outlive the search.
struct SearchProblem {
  std::shared_ptr<const gp::MomentMatching> dynamics;
  const policy::Policy& policy;  // analytic
  const Task& task;              // with a saturating reward
  const Evaluator& evaluator;
  const ProgressSink& progress;
};

/// N(the task's start, the larger of its and the options' deviations).
Gaussian start_state(const Task& task, const SearchOptions& options);

/// The first θ of an analytic policy, PILCO's: centres drawn about the features of the start, targets from N(0, 0.1²),
/// length scales of 1, of cosines and sines 0.7.
Vector initial_policy(const policy::Policy& policy, const Task& task, const SearchOptions& options, std::uint64_t seed,
                      std::uint64_t trial);

/// Maximises the expected return from `start`. What the progress sink throws, passes.
SearchResult search_policy(const SearchProblem& problem, const Vector& start, const SearchOptions& options);

}  // namespace rehearse::learners::pilco
