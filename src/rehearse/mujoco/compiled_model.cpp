#include "rehearse/mujoco/compiled_model.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace rehearse::mujoco {
namespace {

constexpr double kRounding = 1e-6;  // of degrees that a file has
constexpr double kWhole = 1e-6;     // a control step so near a whole number of timesteps is one

std::string joint_name(const mjModel& model, int joint) {
  const char* name = mj_id2name(&model, mjOBJ_JOINT, joint);
  return name ? fmt::format("joint '{}'", name) : fmt::format("joint number {}", joint);
}

}  // namespace

CompiledModel::CompiledModel(const ModelDescription& description)
    : file_(std::filesystem::path(description.path).filename().string()),
      original_(load(description.path)),
      start_values_(static_cast<Index>(description.parameters.size())) {
  for (const ModelParameter& parameter : description.parameters) {
    start_values_(std::ssize(parameter_names_)) = parameter.value;
    parameter_names_.push_back(parameter.name);
  }
  Violations violations;
  read_time(description, violations);
  if (!description.keyframe.empty())
    keyframe_ = find(*original_, mjOBJ_KEY, description.keyframe, "keyframe", violations);
  states_ = States(*original_, description.states, violations);
  find_actions(description.actions, violations);
  parameters_ = Parameters(*original_, description.parameters, violations);
  violations.throw_if_any();
  original_->opt.enableflags &= ~mjENBL_SENSORNOISE;  // of a stream that all threads share
}

SharedModel compile(const ModelDescription& description) { return std::make_shared<const CompiledModel>(description); }
Index timesteps(const SharedModel& model) { return model->substeps(); }

void CompiledModel::read_time(const ModelDescription& description, Violations& violations) {
  const double dt_s = description.dt_s;
  double& timestep = original_->opt.timestep;
  if (!(dt_s > 0 && std::isfinite(dt_s))) return violations.add(fmt::format("dt_s = {}, must be > 0", dt_s));
  if (description.substeps < 0)
    return violations.add(fmt::format("substeps = {}, must be ≥ 1, or 0 for the model's own", description.substeps));
  const double steps = dt_s / timestep;
  substeps_ = description.substeps > 0 ? description.substeps : std::max(Index{1}, std::lround(steps));
  if (description.substeps > 0)
    timestep = dt_s / static_cast<double>(substeps_);
  else if (std::abs(steps - static_cast<double>(substeps_)) > kWhole * steps)
    violations.add(fmt::format(
        "dt_s = {} is {:.6g} timesteps of the model ({} s), must be a whole number; substeps = {} makes it one", dt_s,
        steps, timestep, substeps_));
}

void CompiledModel::find_actions(const std::vector<Action>& actions, Violations& violations) {
  for (const Action& action : actions) {
    const std::string where = fmt::format("action '{}'", action.element);
    const bool on_joint = action.kind == Action::Kind::joint;
    int address = on_joint ? find_scalar_joint(*original_, action.element, where, violations)
                           : find(*original_, mjOBJ_ACTUATOR, action.element, where, violations);
    if (address < 0) continue;
    if (on_joint) address = original_->jnt_dofadr[address];
    for (const Target& other : actions_)
      violations.require(other.kind != action.kind || other.address != address, fmt::format("{} stands twice", where));
    actions_.push_back({action.kind, address});
  }
}

void CompiledModel::act(const Vector& u, mjData& data) const {
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    double* const to = actions_[i].kind == Action::Kind::actuator ? data.ctrl : data.qfrc_applied;
    to[actions_[i].address] = u(static_cast<Index>(i));
  }
}

std::vector<std::string> CompiledModel::unseen() const {
  std::vector<std::string> lines;
  for (int joint = 0; joint < original_->njnt; ++joint) {
    const std::string name = joint_name(*original_, joint);
    if (!states_.gives(State::Kind::position, joint)) lines.push_back(fmt::format("position of {}", name));
    if (!states_.gives(State::Kind::velocity, joint)) lines.push_back(fmt::format("velocity of {}", name));
  }
  if (original_->na > 0) lines.emplace_back("activations of actuators");
  return lines;
}

std::vector<std::string> CompiledModel::misfits(const std::vector<Interval>& bounds, const mjData& start) const {
  const mjModel& model = *original_;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    if (actions_[i].kind != Action::Kind::actuator || !model.actuator_ctrllimited[actions_[i].address]) continue;
    const double* taken = numbers_of<2>(model.actuator_ctrlrange, actions_[i].address);
    if (bounds[i].low < taken[0] - kRounding || bounds[i].high > taken[1] + kRounding)
      lines.push_back(fmt::format(
          "actuator '{}' takes {:g} to {:g}, the action has bounds of {:g} and {:g}: MuJoCo cuts what is beyond",
          mj_id2name(&model, mjOBJ_ACTUATOR, actions_[i].address), taken[0], taken[1], bounds[i].low, bounds[i].high));
  }
  for (int joint = 0; joint < model.njnt; ++joint) {
    const bool scalar = model.jnt_type[joint] == mjJNT_HINGE || model.jnt_type[joint] == mjJNT_SLIDE;
    if (!scalar || !model.jnt_limited[joint]) continue;
    const double at = start.qpos[model.jnt_qposadr[joint]], *range = numbers_of<2>(model.jnt_range, joint);
    if (at < range[0] - kRounding || at > range[1] + kRounding)
      lines.push_back(fmt::format("{} starts at {:.4g}, outside of its range of {:.4g} to {:.4g} (angles are in rad)",
                                  joint_name(model, joint), at, range[0], range[1]));
  }
  return lines;
}

}  // namespace rehearse::mujoco
