#include "rehearse/robot_file/robot_file.hpp"

#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/task.hpp"
#include "rehearse/system/ode.hpp"

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

  void fields(FieldVisitor& v) override {
    for (Parameter& parameter : plant_)
      v.number("plant." + parameter.name, parameter.value, help_of(parameter).c_str());
    v.number("measurement_noise", robot_.measurement_noise, "deviation of every measured state [its unit]",
             at_least(0));
    v.integer("substeps", robot_.substeps, expert("steps of integration of priors and oracle in a control step"),
              between(1, 1e4));
    v.integer("evaluations", evaluations_, "extra episodes for each trial's expected_return; 0: none", between(0, 1e6));
    robot_.policy.fields(v);
  }

  scenario::Scenario build() const override {
    const Task task = make_task(robot_);
    const system::OdeKernel plant = kernel(robot_.plant);
    const ParameterSpace truth(plant_);
    const system::OdePlantOptions options{
        .ode = plant.ode(),
        .phi = truth.values(),
        .dt_s = task.dt_s,
        .start_mean = task.start_mean,
        .start_std = task.start_std,
        .measurement_std = Vector::Constant(task.state_size(), robot_.measurement_noise)};
    scenario::Scenario scenario{.name = robot_.name,
                                .task = task,
                                .make_plant = [options] { return system::make_ode_plant(options); },
                                .oracle = system::make_ode_simulator(plant, truth, task.dt_s, robot_.substeps),
                                .policy = scenario::make_policy(robot_.policy, task, policy_scale(task)),
                                .drawing = make_drawing(robot_),
                                .evaluations = evaluations_};
    for (const Variant& prior : robot_.priors) {
      const ParameterSpace all = prior.parameters.fixed_at(prior.parameters.values());
      scenario.priors.push_back(
          {prior.name, system::make_ode_simulator(kernel(prior), all, task.dt_s, robot_.substeps), prior.parameters});
    }
    return scenario;
  }

 private:
  static std::string help_of(const Parameter& parameter) {
    return "of the robot" + (parameter.unit.empty() ? "" : " [" + parameter.unit + "]");
  }

  system::OdeKernel kernel(const Variant& variant) const {
    return system::formula_kernel(robot_.equation(robot_.dynamics_of(variant)));
  }

  Vector policy_scale(const Task& task) const {
    std::vector<double> scale;
    for (std::size_t i = 0; i < task.states.size(); ++i) {
      const StateKind kind = task.states[i].kind;
      if (kind == StateKind::angle) scale.insert(scale.end(), {1, 1});
      if (kind == StateKind::plain) scale.push_back(robot_.states[i].scale);
    }
    return Vector::Map(scale.data(), static_cast<Index>(scale.size()));
  }

  Robot robot_;
  std::vector<Parameter> plant_;
  Index evaluations_ = 0;
};

}  // namespace

std::unique_ptr<scenario::ScenarioBuilder> builder(std::string_view text, const std::string& source) {
  Robot robot = read(text, source);
  files::FileViolations violations(source);
  check_formulas(robot, violations);
  violations.throw_if_any();
  for (const std::string& line : make_task(robot).violations()) violations.add(0, line);
  violations.throw_if_any();
  return std::make_unique<Builder>(std::move(robot));
}

}  // namespace rehearse::robot_file
