#include "rehearse/experiment/prepared_evaluation.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rehearse::experiment {
namespace {

GivenPolicy policy_wanted(const EvaluationRequest& request, const PastRun& run) {
  if (request.policy) return given_policy(*request.policy, request.policy_source, run.resolved.scenario);
  const TrialRecord& trial = run.trial(request.trial);
  const bool done = trial.trial <= run.history.done();
  return {{policy_of(trial, run.resolved.scenario), trial.theta, trial.trial},
          done ? std::optional(trial.total_reward) : std::nullopt};
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
  std::optional<PastRun> changed;
  violations.attempt([&] { policy = policy_wanted(request, run); });
  request.settings = run.as_identified(request.settings);
  violations.attempt([&] { changed = read_run(catalogue, request.folder, request.settings); });
  violations.throw_if_any();
  const scenario::Scenario& scenario = changed->resolved.scenario;
  if (scenario.require_ready) scenario.require_ready(scenario::PlantUse::driven);
  if (request.seed_of_run) request.plan.seed = changed->resolved.spec.seed;
  return {std::move(request), std::move(*policy), std::move(changed->resolved), was_told(run.history)};
}

std::vector<Outcome> evaluate(const PreparedEvaluation& prepared, const Evaluator& evaluator) {
  return evaluate(prepared.resolved, prepared.policy.learned, prepared.request.plan, evaluator);
}

std::vector<Changed> robustness(const Catalogue& catalogue, const PreparedEvaluation& prepared,
                                const Evaluator& evaluator) {
  const auto changed = [&](const std::string& key, const std::string& value) {
    learners::OptionTexts settings = prepared.request.settings;
    settings.emplace_back(key, value);
    return read_run(catalogue, prepared.request.folder, settings).resolved;
  };
  return robustness(changed, prepared.resolved, prepared.policy.learned, prepared.request.plan, evaluator);
}

}  // namespace rehearse::experiment
