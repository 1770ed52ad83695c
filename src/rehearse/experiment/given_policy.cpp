#include "rehearse/experiment/given_policy.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/past_run.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/policy/hand_over.hpp"

namespace rehearse::experiment {
namespace {

using learners::to_vector, nlohmann::json;

constexpr double kTolerance = 1e-9;

template <class Variables>
std::vector<std::string> variable_names(const Variables& variables) {
  std::vector<std::string> names;
  for (const auto& variable : variables) names.push_back(variable.name);
  return names;
}

std::vector<std::string> variable_names(const json& variables) {
  std::vector<std::string> names;
  for (const json& variable : variables) names.push_back(variable.at("name"));
  return names;
}

/// True if the policy's actions are those in the file.
bool answers_alike(const policy::Policy& policy, const Vector& theta, const Task& task, const json& test) {
  Matrix U(1, policy.actions());
  for (std::size_t i = 0; i < test.at("states").size(); ++i) {
    const Matrix X = to_vector(test.at("states").at(i)).transpose();
    if (X.cols() != task.state_size()) return false;
    policy.act(theta.transpose(), X, test.at("times_s").at(i).get<double>(), U);
    task.actuators().command(X, U);
    const Vector said = to_vector(test.at("actions").at(i));
    if (said.size() != U.cols() ||
        !((said.transpose() - U).cwiseAbs().maxCoeff() <= kTolerance * (1 + said.cwiseAbs().maxCoeff())))
      return false;
  }
  return true;
}

InvalidInput no_export(const std::string& source, const std::string& why = "") {
  return InvalidInput(fmt::format("{} is no policy that `export` wrote as JSON{}", source, why));
}

/// The JSON of a file. Throws InvalidInput, with the line where it ceases to be JSON.
json parsed(const std::string& text, const std::string& source) try {
  return json::parse(text);
} catch (const json::parse_error& error) {
  const std::string_view before = std::string_view(text).substr(0, error.byte);
  throw no_export(source, fmt::format(": line {} is no JSON", 1 + std::ranges::count(before, '\n')));
}

std::string kind_of(const std::string& text, const std::string& source) try {
  return parsed(text, source).at("policy");
} catch (const json::exception&) {
  throw no_export(source);
}

}  // namespace

GivenPolicy given_policy(const std::string& text, const std::string& source, const scenario::Scenario& scenario) try {
  const json file = parsed(text, source);
  if (file.at("format") != 1) throw InvalidInput(fmt::format("{}: another version of Rehearse wrote it", source));
  TrialRecord record{.trial = file.at("trial"), .policy = file.at("policy")};
  constexpr Index kLastTrial = 4294967295;  // of random streams
  if (record.trial < 1 || record.trial > kLastTrial)
    throw InvalidInput(fmt::format("{}: trial = {}, must be 1 to {}", source, record.trial, kLastTrial));
  record.theta = to_vector(file.at("theta"));
  const Task& task = scenario.task;
  const auto wrong = [&](const std::string& why) {
    return InvalidInput(fmt::format("{} is no policy of scenario {}: {}", source, scenario.name, why));
  };
  if (variable_names(file.at("states")) != variable_names(task.states)) throw wrong("its states are others");
  if (variable_names(file.at("actions")) != variable_names(task.actions)) throw wrong("its actions are others");
  const auto policy = [&] {
    try {
      return policy_of(record, scenario);
    } catch (const InvalidInput& error) {
      throw wrong(error.what());
    }
  }();
  if (record.theta.size() != policy->parameters() || !record.theta.allFinite())
    throw wrong(
        fmt::format("theta has {} numbers, must have {} finite ones", record.theta.size(), policy->parameters()));
  if (!answers_alike(*policy, record.theta, task, file.at("test")))
    throw wrong("the run's options make another policy of its theta");
  std::optional<double> total_reward;
  if (const json& earned = file.at("return"); !earned.is_null()) total_reward = earned.get<double>();
  return {{policy, record.theta, record.trial}, total_reward};
} catch (const json::exception&) {
  throw no_export(source);
}

Spec with_start(const Catalogue& catalogue, Spec spec, const std::string& text, const std::string& source) {
  const Resolved resolved = resolve(catalogue, spec);
  const std::string learner = resolved.learner->name(), known = resolved.scenario.policy->name();
  if (!resolved.learner->takes_start())
    throw InvalidInput(fmt::format("{}: {}", source, catalogue.why_no_start(learner)));
  const std::string kind = kind_of(text, source);
  if (kind != known && kind != policy::kHandOver)
    throw InvalidInput(fmt::format("{} is a policy '{}', but learner {} begins with policies '{}' here (option policy)",
                                   source, kind, learner, known));
  const Vector theta = given_policy(text, source, resolved.scenario).learned.theta;
  spec.start = start_text(theta.head(resolved.scenario.policy->parameters()));  // without the feedback
  return resolve(catalogue, spec).spec;
}

}  // namespace rehearse::experiment
