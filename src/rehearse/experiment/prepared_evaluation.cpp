#include "rehearse/experiment/prepared_evaluation.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::experiment {
namespace {

GivenPolicy policy_wanted(const EvaluationRequest& request, const PastRun& run) {
  if (request.policy) return given_policy(*request.policy, request.policy_source, run.resolved.scenario);
  const TrialRecord& trial = run.trial(request.trial);
  const bool done = trial.trial <= run.history.done();
  return {{policy_of(trial, run.resolved.scenario), trial.theta, trial.trial},
          done ? std::optional(trial.total_reward) : std::nullopt};
}

/// The options of a run that may change episodes of its policies, and why others do not.
class ChangesOfEpisodes {
 public:
  explicit ChangesOfEpisodes(const PastRun& run) : prior_plays_(run.resolved.stand_in() != nullptr) {
    scenario::OdeOptions options;
    for (const auto& [name, value] : list_fields([&](FieldVisitor& v) { options.policy.fields(v); }))
      of_policy_.push_back(name);
    for (const auto& [name, value] : list_fields([&](FieldVisitor& v) { options.fields_of_learning(v); }))
      of_learning_.push_back(name);
    for (const auto& [key, value] : run.resolved.spec.options) all_.push_back(key);
  }

  /// Empty: it may, or there is no such option.
  std::string why_not(const std::string& key) const {
    if (const std::string name = without("scenario.", key); is_among("scenario." + name, all_)) {
      if (is_among(name, of_policy_)) return "it is an option of the policy, which stays as it was learned";
      if (is_among(name, of_learning_)) return "it is an option of learning";
      return name == "substeps" && !prior_plays_ ? "it is an option of priors, and none plays the robot" : "";
    }
    if (is_among("learner." + without("learner.", key), all_)) return "it is an option of the learner";
    if (is_among(key, options_of_runs())) return "it is an option of learning";
    return key.starts_with("prior.") && !prior_plays_ ? "no prior plays the robot" : "";
  }

  std::vector<std::string> known() const {
    std::vector<std::string> names;
    for (const std::string& key : all_)
      if (!key.starts_with("learner.") && why_not(key).empty()) names.push_back(without("scenario.", key));
    return names;
  }

 private:
  static std::string without(const std::string& section, const std::string& key) {
    return key.starts_with(section) ? key.substr(section.size()) : key;
  }

  bool prior_plays_;
  std::vector<std::string> all_, of_policy_, of_learning_;
};

/// The settings that change episodes; each other one is a violation.
learners::OptionTexts with_effect(const learners::OptionTexts& settings, const PastRun& run, Violations& violations) {
  const ChangesOfEpisodes changes(run);
  learners::OptionTexts left;
  for (const auto& [key, value] : settings)
    if (const std::string why = changes.why_not(key); why.empty())
      left.emplace_back(key, value);
    else
      violations.add(
          fmt::format("{} changes no episode: {}; what can be set: {}", key, why, fmt::join(changes.known(), ", ")));
  return left;
}

}  // namespace

EvaluationAbout PreparedEvaluation::about() const {
  std::vector<std::string> settings;
  for (const auto& [key, value] : request.settings) settings.push_back(key + "=" + value);
  const Task& task = resolved.scenario.task;
  return {policy.learned.trial, fmt::format("{}", fmt::join(settings, " ")), request.plan.seed,
          seconds(request.plan.steps(task), task.dt_s)};
}

PreparedEvaluation prepare_evaluation(const PastRun& run, EvaluationRequest request, Violations violations) {
  std::optional<GivenPolicy> policy;
  std::optional<Resolved> resolved;
  violations.attempt([&] { policy = policy_wanted(request, run); });
  request.settings = run.as_identified(with_effect(request.settings, run, violations));
  violations.attempt([&] { resolved = resolve_begun(run.catalogue, run.resolved.spec, request.settings); });
  violations.throw_if_any();
  const scenario::Scenario& scenario = resolved->scenario;
  if (scenario.require_ready) scenario.require_ready(scenario::PlantUse::driven);
  if (request.seed_of_run) request.plan.seed = resolved->spec.seed;
  return {std::move(request), std::move(*policy), run.catalogue, std::move(*resolved), was_told(run.history)};
}

std::vector<Outcome> evaluate(const PreparedEvaluation& prepared, const Evaluator& evaluator) {
  return evaluate(prepared.resolved, prepared.policy.learned, prepared.request.plan, evaluator);
}

std::vector<Changed> robustness(const PreparedEvaluation& prepared, const Evaluator& evaluator) {
  const auto make = [&](const std::string& key, const std::string& value) {
    return resolve_begun(prepared.catalogue, prepared.resolved.spec, {{key, value}});
  };
  return robustness(make, prepared.resolved, prepared.policy.learned, prepared.request.plan, evaluator);
}

}  // namespace rehearse::experiment
