#include "rehearse/core/task.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "rehearse/core/angle.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse {
namespace {

/// −1: there is none.
Index index_of(const std::vector<StateVariable>& states, const std::string& name) {
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i].name == name) return static_cast<Index>(i);
  return -1;
}

/// The number of states behind one, each named by the one before as its `next`; as many as there are states: they go in
/// a circle.
Index behind(const std::vector<StateVariable>& states, Index state, std::string StateVariable::*next) {
  Index count = 0;
  for (; count < static_cast<Index>(states.size()); ++count) {
    state = index_of(states, states[static_cast<std::size_t>(state)].*next);
    if (state < 0) break;
  }
  return count;
}

Index rates_behind(const std::vector<StateVariable>& states, Index state) {
  return behind(states, state, &StateVariable::rate);
}

/// The first action of its type.
Index make_of(const std::vector<ActionVariable>& actions, Index action) {
  const std::string& type = actions[static_cast<std::size_t>(action)].servo_type;
  if (type.empty()) return action;
  return std::ranges::find(actions, type, &ActionVariable::servo_type) - actions.begin();
}

/// Names that two columns of a trajectory would have.
std::vector<std::string> ambiguous_names(const Task& task) {
  std::vector<std::string> names = {"time", "reward"}, twice;
  for (const std::string& state : task.state_names()) {
    names.push_back(state);
    names.push_back("true " + state);
  }
  for (const ActionVariable& action : task.actions) names.push_back(action.name);
  std::ranges::sort(names);
  for (std::size_t i = 1; i < names.size(); ++i)
    if (names[i] == names[i - 1] && (twice.empty() || twice.back() != names[i])) twice.push_back(names[i]);
  return twice;
}

}  // namespace

StateCondition each_state(std::function<bool(const ConstVectorView& state)> is) {
  return [is = std::move(is)](const ConstMatrixView& X, VectorView holds) {
    thread_local Vector state;  // this is asked in every step of a batch
    for (Index row = 0; row < X.rows(); ++row) {
      state = X.row(row).transpose();
      holds(row) = is(state) ? 1 : 0;
    }
  };
}

bool holds(const StateCondition& condition, const ConstVectorView& state) {
  const Matrix X = state.transpose();
  Vector value(1);
  condition(X, value);
  return is_true(value(0));
}

FeatureMap Task::feature_map() const {
  std::vector<StateKind> kinds;
  for (const StateVariable& state : states) kinds.push_back(state.kind);
  return FeatureMap(std::move(kinds));
}

FeatureMap Task::model_features() const {
  std::vector<JointAngle> joints;
  for (Index angle = 0; angle < state_size(); ++angle) {
    const Index parent = index_of(states, states[static_cast<std::size_t>(angle)].parent);
    if (parent >= 0) joints.push_back({angle, parent});
  }
  std::vector<Index> targets;
  for (const ActionVariable& action : actions) targets.push_back(index_of(states, action.target_of));
  return FeatureMap(feature_map().kinds(), std::move(joints), std::move(targets));
}

Kinematics Task::kinematics() const {
  Kinematics kinematics{.dt_s = dt_s};
  for (Index position = 0; position < state_size(); ++position) {
    const Index rate = index_of(states, states[static_cast<std::size_t>(position)].rate);
    if (rate >= 0) kinematics.pairs.push_back({position, rate});
  }
  std::ranges::stable_sort(kinematics.pairs, std::greater(),
                           [&](const Kinematics::Pair& pair) { return rates_behind(states, pair.position); });
  for (Index action = 0; action < action_size(); ++action) {
    const ActionVariable& variable = actions[static_cast<std::size_t>(action)];
    const Index position = index_of(states, variable.target_of);
    if (position < 0) continue;
    const Index rate = index_of(states, states[static_cast<std::size_t>(position)].rate);
    kinematics.servos.push_back({action, position, rate, make_of(actions, action)});
  }
  return kinematics;
}

std::vector<std::string> Task::state_names() const {
  std::vector<std::string> names;
  for (const StateVariable& state : states) names.push_back(state.name);
  return names;
}

std::vector<Interval> Task::action_bounds() const {
  std::vector<Interval> bounds;
  for (const ActionVariable& action : actions) bounds.push_back(action.bounds);
  return bounds;
}

std::vector<std::string> Task::descriptor_labels() const {
  if (!descriptor_names.empty()) return descriptor_names;
  std::vector<std::string> labels;
  for (std::size_t d = 1; d <= descriptor_bounds.size(); ++d) labels.push_back(fmt::format("descriptor {}", d));
  return labels;
}

Vector Task::difference(const ConstVectorView& a, const ConstVectorView& b) const {
  Vector apart = a - b;
  for (Index i = 0; i < apart.size(); ++i)
    if (states[static_cast<std::size_t>(i)].kind == StateKind::angle) apart(i) = shorter_way(apart(i));
  return apart;
}

std::vector<std::string> Task::violations() const {
  Violations found;
  found.require(!states.empty(), "task has no states");
  found.require(!actions.empty(), "task has no actions");
  for (const std::string& name : ambiguous_names(*this))
    found.add(fmt::format(
        "{}: two columns of a trajectory would have this name, which are time, reward, the states, \"true\" "
        "and a state, and the actions: choose another",
        name));
  for (Index i = 0; i < state_size(); ++i) {
    const StateVariable& state = states[static_cast<std::size_t>(i)];
    const bool can_follow = state.rate.empty() || (index_of(states, state.rate) >= 0 && state.rate != state.name);
    found.require(can_follow, fmt::format("state {}: its rate {} is not another state", state.name, state.rate));
    found.require(!can_follow || rates_behind(states, i) < state_size(),
                  fmt::format("state {}: its rates go in a circle", state.name));
  }
  for (Index i = 0; i < state_size(); ++i) {
    const StateVariable& state = states[static_cast<std::size_t>(i)];
    const Index parent = index_of(states, state.parent);
    const bool angles = parent >= 0 && state.kind == StateKind::angle &&
                        states[static_cast<std::size_t>(parent)].kind == StateKind::angle;
    found.require(state.parent.empty() || (angles && state.parent != state.name),
                  fmt::format("state {}: {} cannot carry it, both must be angles", state.name, state.parent));
    found.require(behind(states, i, &StateVariable::parent) < state_size(),
                  fmt::format("state {}: its parents go in a circle", state.name));
  }
  for (const ActionVariable& action : actions)
    found.require(
        std::isfinite(action.bounds.low) && std::isfinite(action.bounds.high) && action.bounds.low < action.bounds.high,
        fmt::format("action {}: bounds must be finite with low < high", action.name));
  for (const ActionVariable& action : actions) {
    const Index state = index_of(states, action.target_of);
    const bool plain = state >= 0 && states[static_cast<std::size_t>(state)].kind != StateKind::angle;
    found.require(action.target_of.empty() || plain,
                  fmt::format("action {}: {} must be a state that is no angle, to have it as a target", action.name,
                              action.target_of));
  }
  for (const ActionVariable& action : actions) found.add(Actuators::violations(action, dt_s));
  const Index memories = Actuators(actions, dt_s, 0).memory();
  found.require(memory == memories,
                fmt::format("memory = {}, must be the {} states that its actuators remember", memory, memories));
  found.require(start_mean.size() == state_size() && start_mean.allFinite(),
                fmt::format("start_mean has {} entries, must have {} finite ones", start_mean.size(), state_size()));
  found.require(start_std.size() == state_size() && start_std.allFinite() && (start_std.array() >= 0).all(),
                fmt::format("start_std has {} entries, must have {} of them, ≥ 0", start_std.size(), state_size()));
  found.require(dt_s > 0 && std::isfinite(dt_s), fmt::format("dt_s = {}, must be > 0", dt_s));
  found.require(horizon >= 1, fmt::format("horizon = {}, must be ≥ 1", horizon));
  found.require(static_cast<bool>(reward), "task has no reward");
  for (std::size_t d = 0; d < descriptor_bounds.size(); ++d)
    found.require(std::isfinite(descriptor_bounds[d].high - descriptor_bounds[d].low) &&
                      descriptor_bounds[d].low < descriptor_bounds[d].high,
                  fmt::format("descriptor_bounds {}: must be finite with low < high", d + 1));
  found.require(descriptor_names.empty() || descriptor_names.size() == descriptor_bounds.size(),
                fmt::format("descriptor_names has {} entries, must have {}, as descriptor_bounds, or none",
                            descriptor_names.size(), descriptor_bounds.size()));
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const Limit& limit = limits[i];
    found.require(!limit.name.empty(), fmt::format("limit {} has no name", i + 1));
    found.require(std::ranges::count(limits, limit.name, &Limit::name) == 1,
                  fmt::format("there are two limits {}", limit.name));
    found.require(static_cast<bool>(limit.holds), fmt::format("limit {} has no condition", limit.name));
    found.require(limit.risk > 0 && limit.risk < 1,
                  fmt::format("limit {}: risk = {}, must be above 0 and below 1", limit.name, limit.risk));
  }
  found.require(std::isfinite(reward_floor), fmt::format("reward_floor = {}, must be finite", reward_floor));
  return found.list();
}

Task with_memory(Task task) {
  const Actuators actuators(task.actions, task.dt_s, task.state_size());
  task.memory = actuators.memory();
  const std::vector<StateVariable> memory = actuators.variables();
  task.states.insert(task.states.end(), memory.begin(), memory.end());
  const auto extend = [](Vector& start, const Vector& by) {  // one of a wrong size stays wrong
    start.conservativeResize(start.size() + by.size());
    start.tail(by.size()) = by;
  };
  extend(task.start_mean, actuators.start());
  extend(task.start_std, Vector::Zero(task.memory));
  return task;
}

}  // namespace rehearse
