#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/statistics/intervals.hpp"

namespace rehearse::experiment {

/// True if there is a robot to evaluate policies on: the scenario's plant, or a prior that plays it.
bool has_robot(const Resolved& resolved);

/// Why there is none.
std::string why_no_robot(const Resolved& resolved);

/// The settings of an evaluation: episodes on the plant that do not count as interaction.
struct EvaluationPlan {
  Index episodes = 100;
  double seconds = 0;  // of an episode, at least the task's; 0: the task's
  Index seed = 1;      // of starts and noise

  /// Those whose bounds no task decides.
  void fields(FieldVisitor& v) {
    v.integer("episodes", episodes, "episodes on the plant", between(1, 1e6));
    v.integer("seed", seed, "of starts and noise", between(0, kMostSeed));
  }

  /// Steps of an episode. Throws InvalidInput for whatever is wrong with the plan.
  Index steps(const Task& task) const;
};

/// A policy as it was learned, independent of options set since.
struct Learned {
  std::shared_ptr<const policy::Policy> policy;
  Vector theta;
  Index trial = 1;
};

/// The outcome of one episode.
struct Outcome {
  double total_reward = 0;            // of all its steps
  std::optional<bool> solved;         // by its first task.horizon steps, as a trial is; empty: the task cannot say
  std::optional<bool> solved_at_end;  // by its last task.horizon steps, as if a trial were made of them
  std::optional<double> ended_s;      // when it ended early: a fall, or a broken limit
  std::vector<std::string> broke;     // limits that its last step broke
};

/// Episodes of a policy on the plant, or on the prior that plays the robot (`Resolved::stand_in`), each from random
/// numbers of its own. They are spread over threads in parts that have a plant each: the same outcomes for any number
/// of threads. Throws InvalidInput where plan and policy do not fit the scenario, RunFailed where the plant fails.
std::vector<Outcome> evaluate(const Resolved& resolved, const Learned& learned, const EvaluationPlan& plan,
                              const Evaluator& evaluator);

struct Summary {
  std::optional<statistics::Rate> solved, solved_at_end;  // empty: the task cannot say
  statistics::Rate ended;                                 // early
  std::map<std::string, statistics::Rate> broke;          // by limit; only those that were broken
  std::vector<double> returns;
};
Summary summary_of(const std::vector<Outcome>& outcomes);

/// An evaluation, as its tables name it.
struct EvaluationAbout {
  Index trial = 1;       // of the policy
  std::string settings;  // "plant.m1=0.6"
  Index seed = 1;
  double seconds = 0;  // of an episode
};

/// The first columns of a table of an evaluation, and their cells.
inline const std::vector<std::string> kAboutColumns = {"trial", "settings", "seed", "seconds"};
std::vector<std::string> about_cells(const EvaluationAbout& about);

/// evaluation.csv: a row an episode.
std::string evaluation_csv(const std::vector<Outcome>& outcomes, const EvaluationAbout& about);

}  // namespace rehearse::experiment
