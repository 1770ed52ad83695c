#include "rehearse/robot_file/dynamics.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/mujoco/drawing.hpp"
#include "rehearse/mujoco/plant.hpp"
#include "rehearse/mujoco/simulator.hpp"
#include "rehearse/system/formula_ode.hpp"
#include "rehearse/system/ode.hpp"

namespace rehearse::robot_file {
namespace {

/// Simulates as long as its files are needed.
template <class Made>
std::shared_ptr<const system::Simulator> kept_with(std::shared_ptr<const files::TemporaryFolder> folder,
                                                   std::shared_ptr<Made> made) {
  struct Both {
    std::shared_ptr<const files::TemporaryFolder> folder;  // goes last
    std::shared_ptr<Made> made;
  };
  const auto both = std::make_shared<Both>(Both{std::move(folder), std::move(made)});
  return {both, both->made.get()};
}

/// An error of MuJoCo's reader.
bool names_a_missing_file(const std::string& error) {
  return error.find("could not open") != std::string::npos || error.find("FILE_NOT_FOUND") != std::string::npos;
}

/// The line that a violation of a model is about.
Index line_of(const Dynamics& dynamics, const std::string& violation) {
  for (const auto& [beginning, line] : dynamics.lines)
    if (violation.starts_with(beginning)) return line;
  return dynamics.line;
}

/// Last words of programs in Python and JavaScript.
bool misses_a_file(const std::string& error) {
  for (const char* words : {"No module named", "can't open file", "FileNotFoundError", "Cannot find module"})
    if (error.find(words) != std::string::npos) return true;
  return false;
}

void require_with_files(const system::Program& program, system::ProgramUse use) {
  try {
    system::require_program(program, use);
  } catch (const InvalidInput& error) {
    if (!misses_a_file(error.what())) throw;
    throw InvalidInput(fmt::format(
        "{}\n`files = […]` names what else of the robot's folder a program needs; a library must be one that "
        "'{}' finds, as the PATH has it",
        error.what(), program.command.front()));
  }
}

/// The files that a robot names, where dynamics of this source find them; null: there are no such files.
template <class Source>
std::shared_ptr<const files::TemporaryFolder> folder_for(const Robot& robot) {
  const auto is_such = [](const Dynamics& each) { return std::holds_alternative<Source>(each.source); };
  if (robot.files.empty() || std::ranges::none_of(robot.dynamics, is_such)) return nullptr;
  auto folder = std::make_shared<files::TemporaryFolder>();
  for (const scenario::NamedFile& file : robot.files) folder->add(file.path, file.bytes);
  return folder;
}

}  // namespace

void compile_models(Robot& robot, const Task& task, files::FileViolations& violations) {
  const auto folder = folder_for<ModelSource>(robot);
  const auto own = static_cast<Index>(robot.states.size());
  for (Dynamics& dynamics : robot.dynamics) {
    if (!std::holds_alternative<ModelSource>(dynamics.source)) continue;
    try {
      ModelSource model = std::get<ModelSource>(dynamics.source);
      model.path = folder->path() / model.path;
      model.dt_s = robot.dt_s;
      dynamics.model = mujoco::compile(model);
      dynamics.warnings = mujoco::warnings_of(dynamics.model, task.action_bounds(), task.start_mean.head(own));
    } catch (const InvalidInput& error) {
      const std::string beginning = folder->path().string() + "/";
      for (std::string line : error.violations()) {
        for (std::size_t at; (at = line.find(beginning)) != std::string::npos;) line.erase(at, beginning.size());
        if (names_a_missing_file(line)) line += " (MuJoCo sees only files named in `files = […]`)";
        violations.add(line_of(dynamics, line), fmt::format("[dynamics.{}]: {}", dynamics.name, line));
      }
    }
  }
}

DynamicsMaker::DynamicsMaker(const Robot& robot) : robot_(robot), folder_(folder_for<ProgramSource>(robot)) {}

system::Program DynamicsMaker::program(const Dynamics& dynamics) const {
  const auto& source = std::get<ProgramSource>(dynamics.source);
  system::Program program{.command = source.command,
                          .folder = folder_ ? folder_->path() : std::filesystem::path(),
                          .start_s = source.start_s,
                          .answer_s = source.answer_s,
                          .states = robot_.state_names(),
                          .actions = robot_.action_names(),
                          .dt_s = robot_.dt_s};
  for (const Parameter& parameter : dynamics.parameters) program.parameters.push_back(parameter.name);
  return program;
}

std::shared_ptr<const system::Simulator> DynamicsMaker::simulator(const Variant& variant, Index substeps) {
  const Dynamics& dynamics = robot_.dynamics_of(variant);
  const ParameterSpace fixed = variant.parameters.fixed_at(variant.parameters.values());
  if (std::holds_alternative<ProgramSource>(dynamics.source)) {
    programs_.emplace_back(variant.name, std::make_shared<system::ProgramSimulator>(program(dynamics), fixed));
    return kept_with(folder_, programs_.back().second);
  }
  if (dynamics.model) return mujoco::make_simulator(dynamics.model, fixed);
  if (const auto* function = std::get_if<FunctionSource>(&dynamics.source))
    return system::make_simulator(fixed, function_of(robot_.functions.dynamics, function->name),
                                  robot_.functions.rows_at_once);
  return system::make_ode_simulator(system::formula_kernel(robot_.equation(dynamics)), fixed, robot_.dt_s, substeps);
}

std::function<std::unique_ptr<system::Plant>()> DynamicsMaker::plant(const Variant& variant,
                                                                     const system::StartAndSensors& around) const {
  const Dynamics& dynamics = robot_.dynamics_of(variant);
  if (std::holds_alternative<ProgramSource>(dynamics.source)) {
    const auto oracle = std::ranges::find(programs_, variant.name, [](const auto& named) { return named.first; });
    const auto shared = oracle == programs_.end() ? nullptr : oracle->second;  // so that its faults are counted
    return [program = program(dynamics), phi = variant.parameters, around, folder = folder_, simulator = shared] {
      return system::make_program_plant(program, phi, around, simulator);
    };
  }
  if (dynamics.model)
    return [options = mujoco::PlantOptions{dynamics.model, variant.parameters.values(), around}] {
      return mujoco::make_plant(options);
    };
  if (const auto* function = std::get_if<FunctionSource>(&dynamics.source))
    return
        [change = function_of(robot_.functions.dynamics, function->name), phi = variant.parameters.values(), around] {
          const auto motion = [change, phi](const Vector& x, const Vector& u) -> Vector {
            Matrix moved(1, x.size());
            change(x.transpose(), u.transpose(), phi, moved);
            return x + moved.transpose();
          };
          return system::make_simulated_plant(motion, around);
        };
  const system::OdePlantOptions options{.ode = system::formula_kernel(robot_.equation(dynamics)).ode(),
                                        .phi = variant.parameters.values(),
                                        .dt_s = robot_.dt_s,
                                        .around = around};
  return [options] { return system::make_ode_plant(options); };
}

std::optional<scenario::Drawing> DynamicsMaker::drawing() const {
  std::vector<const Variant*> variants;
  if (robot_.has_plant_dynamics()) variants.push_back(&robot_.plant);
  for (const Variant& prior : robot_.priors) variants.push_back(&prior);
  for (const Variant* variant : variants) {
    const Dynamics& dynamics = robot_.dynamics_of(*variant);
    if (dynamics.model) return mujoco::make_drawing(dynamics.model);
  }
  return {};
}

std::function<std::vector<std::string>()> DynamicsMaker::faults() const {
  if (programs_.empty()) return nullptr;
  return [programs = programs_] {
    std::vector<std::string> sentences;
    for (const auto& [name, program] : programs)
      if (const system::Faults faults = program->faults(); faults.count > 0)
        sentences.push_back(
            fmt::format("{}: its program failed at {} messages, at the last so: {}", name, faults.count, faults.last));
    return sentences;
  };
}

std::function<Index()> DynamicsMaker::lost_rows() const {
  if (programs_.empty()) return nullptr;
  return [programs = programs_] {
    Index lost = 0;
    for (const auto& [name, program] : programs) lost += program->faults().lost;
    return lost;
  };
}

bool DynamicsMaker::is_of_a_prior(const Dynamics& dynamics) const {
  return std::ranges::find(robot_.priors, dynamics.name, &Variant::dynamics) != robot_.priors.end();
}

bool DynamicsMaker::is_of_the_plant(const Dynamics& dynamics) const {
  return robot_.has_plant_dynamics() && robot_.plant.dynamics == dynamics.name;
}

std::function<void(scenario::PlantUse)> DynamicsMaker::require_ready() const {
  std::vector<system::Program> always, driven;
  for (const Dynamics& dynamics : robot_.dynamics) {
    if (!std::holds_alternative<ProgramSource>(dynamics.source)) continue;
    if (is_of_a_prior(dynamics))
      always.push_back(program(dynamics));
    else if (is_of_the_plant(dynamics))
      driven.push_back(program(dynamics));
  }
  if (always.empty() && driven.empty()) return nullptr;
  return [always, driven, folder = folder_](scenario::PlantUse plant) {
    for (const system::Program& program : always) require_with_files(program, system::ProgramUse::simulator);
    if (plant == scenario::PlantUse::left_alone) return;  // its program may move a robot as soon as it starts
    for (const system::Program& program : driven) require_with_files(program, system::ProgramUse::plant);
  };
}

std::function<void()> DynamicsMaker::require_oracle() const {
  for (const Dynamics& dynamics : robot_.dynamics)
    if (is_of_the_plant(dynamics) && std::holds_alternative<ProgramSource>(dynamics.source))
      return [of_plant = program(dynamics), folder = folder_] {
        require_with_files(of_plant, system::ProgramUse::simulator);
      };
  return nullptr;
}

}  // namespace rehearse::robot_file
