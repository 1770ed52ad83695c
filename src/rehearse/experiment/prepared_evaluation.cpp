#include "rehearse/experiment/prepared_evaluation.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/experiment/kept_robot.hpp"

namespace rehearse::experiment {
namespace {

GivenPolicy policy_wanted(const EvaluationRequest& request, const PastRun& run) {
  if (request.policy) return given_policy(*request.policy, request.policy_source, run.resolved.scenario);
  const TrialRecord& trial = run.trial(request.trial);
  const bool done = trial.trial <= run.history.done();
  return {{policy_of(trial, run.resolved.scenario), trial.theta, trial.trial},
          done ? std::optional(trial.total_reward) : std::nullopt};
}

/// A run with options that differ from its own. catalogue: with the run's robot.
Resolved changed(const Catalogue& catalogue, Spec spec, const learners::OptionTexts& settings) {
  spec.options.insert(spec.options.end(), settings.begin(), settings.end());
  return resolve_begun(catalogue, spec);
}

}  // namespace

EvaluationAbout PreparedEvaluation::about() const {
  std::vector<std::string> settings;
  for (const auto& [key, value] : request.settings) settings.push_back(key + "=" + value);
  const Task& task = resolved.scenario.task;
  return {policy.learned.trial, fmt::format("{}", fmt::join(settings, " ")), request.plan.seed,
          seconds(request.plan.steps(task), task.dt_s)};
}

PreparedEvaluation prepare_evaluation(const Catalogue& catalogue, const PastRun& run, EvaluationRequest request) {
  Violations violations;
  std::optional<GivenPolicy> policy;
  std::optional<Resolved> resolved;
  violations.attempt([&] { policy = policy_wanted(request, run); });
  request.settings = run.as_identified(request.settings);
  violations.attempt(
      [&] { resolved = changed(with_robot_of_run(catalogue, request.folder), run.resolved.spec, request.settings); });
  violations.throw_if_any();
  const scenario::Scenario& scenario = resolved->scenario;
  if (scenario.require_ready) scenario.require_ready(scenario::PlantUse::driven);
  if (request.seed_of_run) request.plan.seed = resolved->spec.seed;
  return {std::move(request), std::move(*policy), std::move(*resolved), was_told(run.history)};
}

std::vector<Outcome> evaluate(const PreparedEvaluation& prepared, const Evaluator& evaluator) {
  return evaluate(prepared.resolved, prepared.policy.learned, prepared.request.plan, evaluator);
}

std::vector<Changed> robustness(const Catalogue& catalogue, const PreparedEvaluation& prepared,
                                const Evaluator& evaluator) {
  const Catalogue of_run = with_robot_of_run(catalogue, prepared.request.folder);
  const auto make = [&](const std::string& key, const std::string& value) {
    return changed(of_run, prepared.resolved.spec, {{key, value}});
  };
  return robustness(make, prepared.resolved, prepared.policy.learned, prepared.request.plan, evaluator);
}

}  // namespace rehearse::experiment
