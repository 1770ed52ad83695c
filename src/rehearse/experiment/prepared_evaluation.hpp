#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/given_policy.hpp"
#include "rehearse/experiment/past_run.hpp"
#include "rehearse/experiment/policy_evaluation.hpp"
#include "rehearse/experiment/robustness.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::experiment {

/// The evaluation of a run that a user asks for: a policy, options that differ from the run's, and episodes.
struct EvaluationRequest {
  std::filesystem::path folder;            // of the run
  std::optional<Index> trial = {};         // whose policy; empty: the one with the highest return
  std::optional<std::string> policy = {};  // instead of a trial's, as `export` writes it in JSON
  std::string policy_source = "policy";    // what messages call it, such as its file
  learners::OptionTexts settings = {};     // options that differ from the run's
  EvaluationPlan plan = {};
  bool seed_of_run = true;  // instead of the plan's
};

/// A policy, and the robot on which it is evaluated.
struct PreparedEvaluation {
  EvaluationRequest request;  // whose plan has the seed, and whose settings have the prior's parameters as identified
  GivenPolicy policy;
  Catalogue catalogue;  // with the run's robot
  Resolved resolved;
  bool told = false;  // the run's trials were on a robot that is not its plant

  /// Its names in tables.
  EvaluationAbout about() const;
};

/// Finds the policy in the run, which may be going on, and makes the robot. Where the prior plays it, its parameters
/// are those of the newest model. run: the one in request.folder. Throws InvalidInput if the policy or a setting is
/// wrong, a setting would change no episode, or the robot is not ready (Scenario::require_ready). violations: found
/// before, thrown with those found here.
PreparedEvaluation prepare_evaluation(const PastRun& run, EvaluationRequest request, Violations violations = {});

/// The episodes, or those with one parameter of the robot changed at a time: as the functions of these names for a
/// policy.
std::vector<Outcome> evaluate(const PreparedEvaluation& prepared, const Evaluator& evaluator);
std::vector<Changed> robustness(const PreparedEvaluation& prepared, const Evaluator& evaluator);

}  // namespace rehearse::experiment
