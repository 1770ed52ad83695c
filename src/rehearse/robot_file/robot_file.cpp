#include "rehearse/robot_file/robot_file.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "rehearse/robot_file/details.hpp"
#include "rehearse/robot_file/dynamics.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/start.hpp"
#include "rehearse/robot_file/task.hpp"
#include "rehearse/system/actuated.hpp"
#include "rehearse/system/counted_turns.hpp"

namespace rehearse::robot_file {
namespace {

/// The file's own line, and its condition of success.
std::string summary_of(const Robot& robot) {
  const auto& [when, last_s] = robot.success;
  if (when.empty() || when.is_function()) return robot.summary;
  const std::string solved = last_s > 0 ? fmt::format("solved: {} for the last {:g} s", when.text, last_s)
                                        : fmt::format("solved: {} at the end", when.text);
  return robot.summary.empty() ? solved : robot.summary + "; " + solved;
}

/// A simulator knows a state alone, and begins each step with the rest of its model as the model has it.
std::vector<std::string> lines_of_unseen(const Dynamics& dynamics) {
  std::vector<std::string> lines;
  for (const std::string& part : dynamics.warnings.unseen)
    lines.push_back("not among the states, so each step begins with it at rest: " + part);
  return lines;
}

class Builder final : public scenario::ScenarioBuilder {
 public:
  explicit Builder(Robot robot)
      : robot_(std::move(robot)),
        plant_(robot_.plant.parameters.all()),
        has_actuators_(robot_.actuators().memory() > 0 || robot_.plant_actuators().memory() > 0) {}

  std::string name() const override { return robot_.name; }
  std::string summary() const override { return summary_of(robot_); }

  std::vector<std::string> prior_names() const override {
    std::vector<std::string> names;
    for (const Variant& prior : robot_.priors) names.push_back(prior.name);
    return names;
  }

  void fields(FieldVisitor& v) override {
    robot_.options.fields_of_robot(v, plant_);
    v.require(robot_.plant_function.empty() || robot_.options.measurement_noise == 0,
              "measurement_noise: the plant is a function, which measures by itself, noise included");
    v.require(has_equations() || robot_.options.substeps == scenario::OdeOptions().substeps,
              "substeps: no dynamics are equations; a model of MuJoCo has substeps in the robot's file");
    if (!has_actuators_ || !robot_.has_plant) return;
    for (std::size_t a = 0; a < robot_.actions.size(); ++a) {
      Actuation& own = robot_.plant_actuation[a];
      const std::string& name = robot_.actions[a].name;
      v.number("plant.delay_s." + name, own.delay_s, "from the command until the robot gets it [s]",
               between(0, Actuators::kMostSteps * robot_.dt_s));
      v.number("plant.lag_s." + name, own.lag_s, "time constant with which the robot follows the command [s]",
               at_least(0));
    }
  }

  scenario::Scenario build() const override {
    DynamicsMaker dynamics(robot_);
    const Variant plant{robot_.plant.name, robot_.plant.dynamics, ParameterSpace(plant_)};
    const Task task = make_task(robot_);
    const Actuators actuators = robot_.actuators();
    const system::StartAndSensors around = around_robot(task, actuators.own_states());
    scenario::Scenario scenario{.name = robot_.name,
                                .task = task,
                                .policy = make_policy(robot_.options.policy, task, policy_scale()),
                                .drawing = robot_.bodies.empty() ? drawing_of_model(dynamics) : make_drawing(robot_),
                                .require_ready = dynamics.require_ready(),
                                .evaluations = robot_.options.evaluations};
    if (!robot_.plant_function.empty()) {
      scenario.make_plant = [make = function_of(robot_.functions.plants, robot_.plant_function),
                             turns = Turns(around.angles, around.start_mean)] {
        return system::with_turns_counted(make(), turns);
      };
    } else if (robot_.has_plant) {
      scenario.oracle = dynamics.simulator(plant, robot_.options.substeps);
      scenario.make_plant = dynamics.plant(plant, around);
      scenario.require_oracle = dynamics.require_oracle();
      scenario.oracle_lacks = oracle_lacks();
    }
    if (!around.measurement_std.isZero(0)) {
      scenario.stand_in_noise = Vector::Zero(task.state_size());
      scenario.stand_in_noise.head(actuators.own_states()) = around.measurement_std;
    }
    for (const Variant& prior : robot_.priors)
      scenario.priors.push_back({.name = prior.name,
                                 .simulator = dynamics.simulator(prior, robot_.options.substeps),
                                 .parameters = prior.parameters,
                                 .lacks = lines_of_prior(prior)});
    if (has_actuators_) put_actuators_in_front(scenario, actuators);
    scenario.faults = dynamics.faults();
    scenario.lost_rows = dynamics.lost_rows();
    return scenario;
  }

  std::vector<std::string> stated() const override { return robot_.stated; }
  std::vector<scenario::NamedFile> files() const override { return robot_.files; }

  scenario::Details details() const override {
    return details_of(robot_, plant_, robot_.options.measurement_std(robot_.actuators().own_states()));
  }

 private:
  bool has_equations() const {
    return std::ranges::any_of(robot_.dynamics,
                               [](const Dynamics& each) { return std::holds_alternative<Equations>(each.source); });
  }

  /// Start and noise of the robot's own states.
  system::StartAndSensors around_robot(const Task& task, Index own) const {
    return {task.start_mean.head(own), task.start_std.head(own), robot_.options.measurement_std(own), angles()};
  }

  std::vector<Index> angles() const {
    std::vector<Index> angles;
    for (Index i = 0; i < std::ssize(robot_.states); ++i)
      if (robot_.states[static_cast<std::size_t>(i)].variable.kind == StateKind::angle) angles.push_back(i);
    return angles;
  }

  /// The drawing of the model, whose states are the robot's own alone.
  std::optional<scenario::Drawing> drawing_of_model(const DynamicsMaker& dynamics) const {
    std::optional<scenario::Drawing> drawing = dynamics.drawing();
    auto* solids = drawing ? std::get_if<scenario::SolidDrawing>(&*drawing) : nullptr;
    if (solids && robot_.actuators().memory() > 0)
      solids->poses = [poses = solids->poses, own = robot_.actuators().own_states()](const ConstVectorView& state) {
        return poses(state.head(own));
      };
    return drawing;
  }

  void put_actuators_in_front(scenario::Scenario& scenario, const Actuators& actuators) const {
    if (scenario.make_plant)
      scenario.make_plant = [make = scenario.make_plant, actuators, own = robot_.plant_actuators()] {
        return system::with_actuators(make(), actuators, own);
      };
    if (actuators.memory() == 0) return;
    if (scenario.oracle) scenario.oracle = system::with_actuators(scenario.oracle, actuators);
    for (scenario::NamedPrior& prior : scenario.priors)
      prior.simulator = system::with_actuators(prior.simulator, actuators);
  }

  std::vector<std::string> lines_of_prior(const Variant& prior) const {
    const Dynamics& dynamics = robot_.dynamics_of(prior);
    std::vector<std::string> lines = lines_of_unseen(dynamics);
    const bool said = robot_.has_plant_dynamics() && robot_.plant.dynamics == dynamics.name;  // of the plant
    if (!said) lines.insert(lines.end(), dynamics.warnings.misfits.begin(), dynamics.warnings.misfits.end());
    if (said) add_out_of_reach(prior, lines);
    if (!said && robot_.has_plant_dynamics()) add_other_timestep(dynamics, lines);
    add_negative_masses(prior, lines);
    return lines;
  }

  /// Parameters of the plant that are outside of the bounds in which the prior learns them.
  void add_out_of_reach(const Variant& prior, std::vector<std::string>& lines) const {
    for (const Parameter& learned : prior.parameters.all())
      for (const Parameter& of_plant : plant_)
        if (learned.kind == Parameter::Kind::continuous && learned.name == of_plant.name &&
            (of_plant.value < learned.box.low || of_plant.value > learned.box.high))
          lines.push_back(fmt::format("{} is {:g} in the plant, outside of [{:g}, {:g}], in which it is learned",
                                      learned.name, of_plant.value, learned.box.low, learned.box.high));
  }

  /// A model whose timestep is not the plant's moves otherwise, most of all where bodies touch.
  void add_other_timestep(const Dynamics& of_prior, std::vector<std::string>& lines) const {
    const Dynamics& of_plant = robot_.dynamics_of(robot_.plant);
    if (!of_plant.model || !of_prior.model) return;
    const Index plant = mujoco::timesteps(of_plant.model), prior = mujoco::timesteps(of_prior.model);
    if (plant != prior)
      lines.push_back(fmt::format(
          "MuJoCo does {} timesteps a control step in the plant, {} in the prior (substeps, or the timestep "
          "of the model)",
          plant, prior));
  }

  static void add_negative_masses(const Variant& prior, std::vector<std::string>& lines) {
    for (const Parameter& p : prior.parameters.all()) {
      constexpr std::array<std::string_view, 6> kUnits = {"g", "kg", "kg m²", "kg m^2", "kg·m²", "kg*m^2"};
      if (std::ranges::find(kUnits, p.unit) == kUnits.end()) continue;
      if (p.value < 0)
        lines.push_back(fmt::format("{} is {:g} {}: no mass is negative", p.name, p.value, p.unit));
      else if (p.kind == Parameter::Kind::continuous && p.box.low < 0)
        lines.push_back(fmt::format("{} is learned in [{:g}, {:g}] {}: no mass is negative", p.name, p.box.low,
                                    p.box.high, p.unit));
    }
  }

  /// Parts of the plant's model that no state gives, and delays and lags: a simulator sees earlier commands by the
  /// task's memory alone, which has the size for the task's own delay and lag.
  std::vector<std::string> oracle_lacks() const {
    std::vector<std::string> lines = lines_of_unseen(robot_.dynamics_of(robot_.plant));
    for (std::size_t a = 0; a < robot_.actions.size(); ++a) {
      const Actuation &known = robot_.actions[a].actuation, &own = robot_.plant_actuation[a];
      if (known.delay_s != own.delay_s || known.lag_s != own.lag_s)
        lines.push_back(
            fmt::format("{}: the plant has delay_s = {:g} and lag_s = {:g}, its oracle those of the action, as all "
                        "models: {:g} and {:g}",
                        robot_.actions[a].name, own.delay_s, own.lag_s, known.delay_s, known.lag_s));
    }
    return lines;
  }

  Vector policy_scale() const {
    std::vector<double> scale;
    for (const State& state : robot_.states) {
      if (state.variable.kind == StateKind::angle) scale.insert(scale.end(), {1, 1});
      if (state.variable.kind == StateKind::plain) scale.push_back(state.scale);
    }
    const Vector memory = robot_.actuators().scale();
    scale.insert(scale.end(), memory.begin(), memory.end());
    return Vector::Map(scale.data(), static_cast<Index>(scale.size()));
  }

  Robot robot_;
  std::vector<Parameter> plant_;
  bool has_actuators_;  // as the file says
};

}  // namespace

scenario::MakeBuilder maker(std::string_view text, const std::string& source, const scenario::ReadFile& read_file,
                            const Functions& functions) {
  Robot robot = read(text, source, read_file, functions);
  files::FileViolations violations(source);
  check_formulas(robot, violations);
  violations.throw_if_any();
  const Task task = make_task(robot);
  compile_models(robot, task, violations);
  for (const std::string& line : task.violations()) violations.add(0, line);
  check_start(robot, task, violations);
  violations.throw_if_any();
  return [made = std::make_shared<const Builder>(std::move(robot))] { return std::make_unique<Builder>(*made); };
}

std::unique_ptr<scenario::ScenarioBuilder> builder(std::string_view text, const std::string& source,
                                                   const scenario::ReadFile& read_file, const Functions& functions) {
  return maker(text, source, read_file, functions)();
}

}  // namespace rehearse::robot_file
