#include "rehearse/robot_file/details.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"

namespace rehearse::robot_file {
namespace {

std::vector<std::string> details_of_reward(const RewardFormulas& reward) {
  std::vector<std::string> lines, distances;
  for (const Formula& distance : reward.distance) distances.push_back(distance.text);
  const bool ignored = distances.empty() && reward.width != RewardFormulas().width;
  if (distances.empty())
    lines.push_back(
        fmt::format("formula: {}{}", reward.formula.text,
                    ignored ? fmt::format("; width {:g} is of distances, so it has no effect", reward.width) : ""));
  else
    lines.push_back(fmt::format("distance: {}; width {:g}", fmt::join(distances, ", "), reward.width));
  if (!reward.cost.empty()) lines.push_back("cost: " + reward.cost.text);
  if (!reward.episode.empty()) lines.push_back("of the whole episode: " + reward.episode.text);
  lines.push_back(fmt::format("floor {:g}", reward.floor));
  return lines;
}

std::string source_of(const Dynamics& dynamics) {
  if (const auto* program = std::get_if<ProgramSource>(&dynamics.source))
    return fmt::format("the program '{}'", fmt::join(program->command, " "));
  if (const auto* model = std::get_if<ModelSource>(&dynamics.source)) return fmt::format("the model {}", model->path);
  if (const auto* function = std::get_if<FunctionSource>(&dynamics.source))
    return fmt::format("the function {}", function->name);
  return "equations";
}

std::string values_of(const std::vector<Parameter>& parameters) {
  std::vector<std::string> values;
  for (const Parameter& each : parameters)
    values.push_back(fmt::format("{} = {:g}{}", each.name, each.value, unit_text(each.unit)));
  return fmt::format("{}", fmt::join(values, ", "));
}

std::vector<std::string> details_of_plant(const Robot& robot, const std::vector<Parameter>& plant,
                                          const Vector& noise) {
  if (!robot.plant_function.empty()) return {"the function " + robot.plant_function};
  if (!robot.has_plant) return {};
  const Dynamics& dynamics = robot.dynamics_of(robot.plant);
  std::vector<std::string> lines{fmt::format("dynamics {}, {}", dynamics.name, source_of(dynamics))};
  if (!plant.empty()) lines.push_back(values_of(plant));
  std::vector<std::string> noises;
  for (Index i = 0; i < noise.size(); ++i)
    if (noise(i) > 0)
      noises.push_back(fmt::format("{} ± {:g}", robot.states[static_cast<std::size_t>(i)].variable.name, noise(i)));
  const bool measures_itself = std::holds_alternative<ProgramSource>(dynamics.source);
  lines.push_back(noises.empty() ? (measures_itself ? "measured as its program does" : "measured without noise")
                                 : fmt::format("measured with noise: {}", fmt::join(noises, ", ")));
  lines.insert(lines.end(), dynamics.warnings.misfits.begin(), dynamics.warnings.misfits.end());
  return lines;
}

}  // namespace

scenario::Details details_of(const Robot& robot, const std::vector<Parameter>& plant, const Vector& noise) {
  scenario::Details details{.reward = details_of_reward(robot.reward),
                            .ended = robot.ended.text,
                            .plant = details_of_plant(robot, plant, noise)};
  for (const Variant& prior : robot.priors) {
    const Dynamics& dynamics = robot.dynamics_of(prior);
    details.priors.push_back(fmt::format("dynamics {}, {}", dynamics.name, source_of(dynamics)));
  }
  return details;
}

}  // namespace rehearse::robot_file
