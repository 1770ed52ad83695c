#include "rehearse/robot_file/robot_file.hpp"

#include "rehearse/robot_file/dynamics.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/task.hpp"

namespace rehearse::robot_file {
namespace {

class Builder final : public scenario::ScenarioBuilder {
 public:
  explicit Builder(Robot robot) : robot_(std::move(robot)), plant_(robot_.plant.parameters.all()) {}

  std::string name() const override { return robot_.name; }
  std::string summary() const override { return robot_.summary; }

  std::vector<std::string> prior_names() const override {
    std::vector<std::string> names;
    for (const Variant& prior : robot_.priors) names.push_back(prior.name);
    return names;
  }

  void fields(FieldVisitor& v) override { robot_.options.fields_of_robot(v, plant_); }

  scenario::Scenario build() const override {
    DynamicsMaker dynamics(robot_);
    const Variant plant{robot_.plant.name, robot_.plant.dynamics, ParameterSpace(plant_)};
    const Task task = make_task(robot_);
    const Vector noise = Vector::Constant(task.state_size(), robot_.options.measurement_noise);
    scenario::Scenario scenario{.name = robot_.name,
                                .task = task,
                                .policy = make_policy(robot_.options.policy, task, policy_scale()),
                                .drawing = robot_.bodies.empty() ? dynamics.drawing() : make_drawing(robot_),
                                .require_ready = dynamics.require_ready(),
                                .evaluations = robot_.options.evaluations};
    if (!robot_.plant_function.empty()) {
      scenario.make_plant = robot_.functions.plants.at(robot_.plant_function);
    } else if (robot_.has_plant) {
      scenario.make_plant = dynamics.plant(plant, {task.start_mean, task.start_std, noise});
      scenario.oracle = dynamics.simulator(plant, robot_.options.substeps);
    }
    for (const Variant& prior : robot_.priors)
      scenario.priors.push_back({prior.name, dynamics.simulator(prior, robot_.options.substeps), prior.parameters});
    scenario.faults = dynamics.faults();
    return scenario;
  }

  std::vector<scenario::NamedFile> files() const override { return robot_.files; }

 private:
  Vector policy_scale() const {
    std::vector<double> scale;
    for (const State& state : robot_.states) {
      if (state.variable.kind == StateKind::angle) scale.insert(scale.end(), {1, 1});
      if (state.variable.kind == StateKind::plain) scale.push_back(state.scale);
    }
    return Vector::Map(scale.data(), static_cast<Index>(scale.size()));
  }

  Robot robot_;
  std::vector<Parameter> plant_;
};

}  // namespace

std::unique_ptr<scenario::ScenarioBuilder> builder(std::string_view text, const std::string& source,
                                                   const scenario::ReadFile& read_file, const Functions& functions) {
  Robot robot = read(text, source, read_file, functions);
  files::FileViolations violations(source);
  check_formulas(robot, violations);
  violations.throw_if_any();
  DynamicsMaker(robot).check_models(violations);
  for (const std::string& line : make_task(robot).violations()) violations.add(0, line);
  violations.throw_if_any();
  return std::make_unique<Builder>(std::move(robot));
}

}  // namespace rehearse::robot_file
