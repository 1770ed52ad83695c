#pragma once

#include <optional>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/optim/race.hpp"
#include "rehearse/optim/restarts.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::learners::black_drops {

enum class Method {
  race,      // many descents that compete: on the pendubot's true dynamics it finds a solution with far fewer rollouts
  restarts,  // one after the other, the paper's: BIPOP, with uncertainty handling and elitism if asked for
};

/// Each rollout is one noisy measurement of the expected return, which CMA-ES maximises (Chatzilygeroudis 2017).
struct SearchOptions {
  Method method = Method::race;
  double box = 5;       // θ in [−box, box] unless the policy has a box of its own; the authors' code
  Index particles = 1;  // rollouts of one evaluation; the paper: 1
  rollout::SimulateOptions simulate;
  optim::RaceOptions race;
  optim::SearchOptions restarts{.max_evaluations = 200000};
  Index finalists = 4;    // best policies found that are compared once more, together with those it started from
  Index selection = 100;  // rollouts of each of them, if they can differ; their mean is the predicted return
  void fields(FieldVisitor& v);
};

struct SearchResult {
  Vector theta;
  double predicted_return = 0;
  double solving = 0;              // how surely it solves the task, where that was asked
  std::vector<Vector> runners_up;  // other good policies, best first
  Index rollouts = 0;
  Index failed_rollouts = 0;
};

/// The problem of a search. References must outlive it.
struct SearchProblem {
  const dynamics::DynamicsModel& model;
  const policy::Policy& policy;
  const Task& task;
  const Evaluator& evaluator;
  const ProgressSink& progress;
};

/// Rollouts by which a policy is compared with others: `selection`, or 1 where model, start and measurements are
/// certain.
Index comparisons(const SearchProblem& problem, const SearchOptions& options);

/// The policy of the highest expected return in the model, never worse there than `starts`, from which the first
/// descents begin. `key` names the search: its stage and number tell it from the others of its trial.
SearchResult search_policy(const SearchProblem& problem, const std::vector<Vector>& starts,
                           const SearchOptions& options, const StreamKey& key);

/// The expected return of one policy, with the same random numbers for all policies that are judged with one key.
SearchResult judge(const SearchProblem& problem, const Vector& theta, const SearchOptions& options,
                   const StreamKey& key);

/// How often each policy solves the task in simulated episodes, all policies in the same; 0 if the task does
/// not say.
Vector solving_rates(const SearchProblem& problem, const std::vector<Vector>& policies, const SearchOptions& options,
                     const StreamKey& key);

/// θ uniform in the box.
Vector random_policy(const policy::Policy& policy, const SearchOptions& options, StreamKey key);

}  // namespace rehearse::learners::black_drops
