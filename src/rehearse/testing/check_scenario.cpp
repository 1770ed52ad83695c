#include "rehearse/testing/check_scenario.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/reward/saturating.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/testing/check_plant.hpp"
#include "rehearse/testing/check_policy.hpp"
#include "rehearse/testing/check_simulator.hpp"

namespace rehearse::testing {
namespace {

/// One finite line a body, in every state.
std::vector<std::string> check_drawing(const scenario::LineDrawing& drawing, const Matrix& states) {
  for (Index t = 0; t < states.rows(); ++t) {
    const std::vector<scenario::Line> lines = drawing.lines(Vector(states.row(t)));
    if (lines.size() != drawing.bodies.size())
      return {fmt::format("{} lines for {} bodies", lines.size(), drawing.bodies.size())};
    for (const scenario::Line& line : lines)
      if (!line.from.allFinite() || !line.to.allFinite()) return {fmt::format("not finite in state {}", t)};
  }
  return {};
}

/// One finite pose a body, whose quaternion is a rotation, in every state.
std::vector<std::string> check_drawing(const scenario::SolidDrawing& drawing, const Matrix& states) {
  for (Index t = 0; t < states.rows(); ++t) {
    const std::vector<scenario::Pose> poses = drawing.poses(Vector(states.row(t)));
    if (poses.size() != drawing.bodies.size())
      return {fmt::format("{} poses for {} bodies", poses.size(), drawing.bodies.size())};
    for (const auto& [position, orientation] : poses) {
      if (!position.allFinite()) return {fmt::format("not finite in state {}", t)};
      const double norm = orientation.norm();
      if (!(std::abs(norm - 1) <= 1e-9)) return {fmt::format("a quaternion of norm {} in state {}", norm, t)};
    }
  }
  return {};
}

/// The closed form of the reward gives what the reward gives.
std::vector<std::string> check_closed_form(const reward::ClosedForm& form, const Task& task, const Dataset& data) {
  Vector rewards(data.size());
  task.reward(data.states, data.actions, data.states, rewards);
  const FeatureMap features = task.feature_map();
  Matrix F(data.size(), features.features());
  features.apply(data.states, F);
  const auto& [goal, distances] = form;
  if (goal.size() != F.cols() || distances.cols() != F.cols())
    return {fmt::format("is of {} and {} features, must be of {}", goal.size(), distances.cols(), F.cols())};
  for (Index t = 0; t < data.size(); ++t) {
    const double value = std::exp(-(distances * (F.row(t).transpose() - goal)).squaredNorm() / 2);
    if (!(std::abs(value - rewards(t)) <= 1e-12))
      return {fmt::format("{} in state {}, where the reward is {}", value, t, rewards(t))};
  }
  return {};
}

/// Checks that a descriptor has as many numbers as bounds, all finite.
std::vector<std::string> check_descriptor(const Task& task, const Dataset& data) {
  const Index T = data.size() - 1;
  const Vector descriptor = task.descriptor({.states = data.states,
                                             .true_states = data.states,
                                             .actions = data.actions.topRows(T),
                                             .rewards = data.rewards.head(T)});
  if (descriptor.size() != static_cast<Index>(task.descriptor_bounds.size()))
    return {fmt::format("{} numbers, but {} descriptor_bounds", descriptor.size(), task.descriptor_bounds.size())};
  if (!descriptor.allFinite()) return {"not finite"};
  return {};
}

}  // namespace

Dataset random_episodes(const scenario::Scenario& scenario, Index episodes, std::uint64_t seed) {
  Dataset data;
  const auto plant = scenario.make_plant();
  for (Index e = 0; e < episodes; ++e) {
    Rng rng({.seed = seed, .trial = static_cast<std::uint64_t>(e), .purpose = Purpose::random_policy});
    Vector theta(scenario.policy->parameters());
    for (double& value : theta) value = rng.uniform(-5, 5);
    data.append(rollout::execute(*plant, *scenario.policy, theta, scenario.task, rng));
  }
  return data;
}

std::vector<std::string> check_scenario(const scenario::Scenario& scenario) {
  std::vector<std::string> found = scenario.task.violations();
  if (!found.empty()) return found;
  const auto add = [&](const std::string& what, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) found.push_back(what + ": " + line);
  };
  add("plant", check_plant(scenario.make_plant, scenario.task));
  add("policy", check_policy(*scenario.policy, scenario.task));
  if (!found.empty()) return found;
  const Dataset data = random_episodes(scenario, 1);
  for (const scenario::NamedPrior& prior : scenario.priors)
    for (const auto& simulator : {prior.simulator, prior.driven})
      if (simulator)
        add((simulator == prior.driven ? "driven prior " : "prior ") + prior.name,
            check_simulator(*simulator, data.states, data.actions, prior.parameters.values()));
  if (scenario.oracle)
    add("oracle", check_simulator(*scenario.oracle, data.states, data.actions, scenario.oracle->parameters().values()));
  if (const auto* form = reward::closed_form(scenario.task.reward))
    add("closed form of the reward", check_closed_form(*form, scenario.task, data));
  if (scenario.task.descriptor) add("descriptor", check_descriptor(scenario.task, data));
  if (scenario.drawing)
    add("drawing", std::visit([&](const auto& kind) { return check_drawing(kind, data.states); }, *scenario.drawing));
  return found;
}

}  // namespace rehearse::testing
