#include "rehearse/mujoco/states.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rehearse::mujoco {
namespace {

std::string where(const State& state) { return fmt::format("state '{}'", state.name); }

bool is_settable(State::Kind kind) { return kind == State::Kind::position || kind == State::Kind::velocity; }

const double* array_of(const mjData& data, State::Kind kind) {
  switch (kind) {
    case State::Kind::position:
      return data.qpos;
    case State::Kind::velocity:
      return data.qvel;
    case State::Kind::sensor:
      return data.sensordata;
    case State::Kind::body:
      return data.xpos;
    case State::Kind::site:
      return data.site_xpos;
  }
  return nullptr;
}

/// −1 and a violation unless the component is below size.
int component(const State& state, const Term& term, int begin, int size, Violations& violations) {
  if (term.component >= 0 && term.component < size) return begin + static_cast<int>(term.component);
  violations.add(fmt::format("{}: component = {} of '{}', must be from 0 to {}", where(state), term.component,
                             term.element, size - 1));
  return -1;
}

void check_terms(const State& state, Violations& violations) {
  violations.require(!state.terms.empty(), fmt::format("{} has no terms, must have one", where(state)));
  violations.require(std::isfinite(state.offset),
                     fmt::format("{}: offset = {}, must be finite", where(state), state.offset));
  for (auto term = state.terms.begin(); term != state.terms.end(); ++term) {
    violations.require(
        std::isfinite(term->factor) && term->factor != 0,
        fmt::format("{}: factor = {} of '{}', must be finite and not 0", where(state), term->factor, term->element));
    const bool twice = is_settable(state.kind) && std::any_of(state.terms.begin(), term, [&](const Term& other) {
                         return other.element == term->element;
                       });
    violations.require(!twice, fmt::format("{} names the joint '{}' twice", where(state), term->element));
  }
}

int joint_of(const mjModel& model, const Term& term) { return mj_name2id(&model, mjOBJ_JOINT, term.element.c_str()); }

std::vector<std::string> joint_names(const mjModel& model, const std::vector<int>& joints) {
  std::vector<std::string> names;
  names.reserve(joints.size());
  for (const int joint : joints) names.emplace_back(mj_id2name(&model, mjOBJ_JOINT, joint));
  return names;
}

}  // namespace

States::States(const mjModel& model, const std::vector<State>& states, Violations& violations) {
  const std::size_t before = violations.list().size();
  for (const State& state : states) {
    check_terms(state, violations);
    Reading reading{state.kind, state.offset, {}};
    for (const Term& term : state.terms)
      reading.numbers.push_back({address(model, state, term, violations), term.factor});
    places_ = places_ || state.kind == State::Kind::body || state.kind == State::Kind::site;
    sensors_ = sensors_ || state.kind == State::Kind::sensor;
    states_.push_back(std::move(reading));
  }
  if (violations.list().size() > before) return;
  positions_ = setting(model, states, State::Kind::position, violations);
  velocities_ = setting(model, states, State::Kind::velocity, violations);
}

int States::address(const mjModel& model, const State& state, const Term& term, Violations& violations) const {
  if (is_settable(state.kind)) {
    const int joint = find_scalar_joint(model, term.element, where(state), violations);
    if (joint < 0) return -1;
    const int begin = state.kind == State::Kind::position ? model.jnt_qposadr[joint] : model.jnt_dofadr[joint];
    return component(state, term, begin, 1, violations);
  }
  const bool sensor = state.kind == State::Kind::sensor;
  const mjtObj type = sensor ? mjOBJ_SENSOR : state.kind == State::Kind::body ? mjOBJ_BODY : mjOBJ_SITE;
  const int id = find(model, type, term.element, where(state), violations);
  if (id < 0) return -1;
  if (!sensor) return component(state, term, 3 * id, 3, violations);
  return component(state, term, model.sensor_adr[id], model.sensor_dim[id], violations);
}

States::Setting States::setting(const mjModel& model, const std::vector<State>& states, State::Kind kind,
                                Violations& violations) {
  Setting setting;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].kind != kind) continue;
    setting.states.push_back(static_cast<Index>(i));
    names.push_back(states[i].name);
    for (const Term& term : states[i].terms) setting.add_joint(model, term);
  }
  const std::string what = fmt::format(
      "the {} {} ({}) of {} joints ({})", names.size(), kind == State::Kind::position ? "positions" : "velocities",
      fmt::join(names, ", "), setting.joints.size(), fmt::join(joint_names(model, setting.joints), ", "));
  if (names.size() != setting.joints.size())
    violations.add(fmt::format("{}: there must be one of each joint", what));
  else if (!names.empty() && !setting.invert(setting.factors(model, states)))
    violations.add(fmt::format("{} do not tell these apart: one follows from others", what));
  for (const int joint : setting.joints)
    setting.addresses.push_back(kind == State::Kind::position ? model.jnt_qposadr[joint] : model.jnt_dofadr[joint]);
  return setting;
}

void States::Setting::add_joint(const mjModel& model, const Term& term) {
  const int joint = joint_of(model, term);
  if (std::find(joints.begin(), joints.end(), joint) == joints.end()) joints.push_back(joint);
}

Matrix States::Setting::factors(const mjModel& model, const std::vector<State>& of) const {
  Matrix factors = Matrix::Zero(static_cast<Index>(states.size()), static_cast<Index>(joints.size()));
  for (Index s = 0; s < factors.rows(); ++s)
    for (const Term& term : of[static_cast<std::size_t>(states[static_cast<std::size_t>(s)])].terms)
      factors(s, std::find(joints.begin(), joints.end(), joint_of(model, term)) - joints.begin()) = term.factor;
  return factors;
}

bool States::Setting::invert(const Matrix& factors) {
  const Eigen::FullPivLU<Matrix> lu(factors);
  if (lu.isInvertible()) inverse = lu.inverse();
  return lu.isInvertible();
}

void States::Setting::write(const Vector& x, const std::vector<Reading>& readings, double* numbers) const {
  for (std::size_t j = 0; j < addresses.size(); ++j) {
    double sum = 0;
    for (std::size_t s = 0; s < states.size(); ++s) {
      const double factor = inverse(static_cast<Index>(j), static_cast<Index>(s));
      // a factor of zero must not spread a state that is not finite
      if (factor != 0) sum += factor * (x(states[s]) - readings[static_cast<std::size_t>(states[s])].offset);
    }
    numbers[addresses[j]] = sum;
  }
}

void States::write(const Vector& x, mjData& data) const {
  positions_.write(x, states_, data.qpos);
  velocities_.write(x, states_, data.qvel);
}

void States::prepare(const mjModel& model, mjData& data) const {
  if (sensors_)
    mj_forward(&model, &data);
  else if (places_)
    mj_kinematics(&model, &data);
}

void States::read(const mjData& data, Vector& x) const {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const double* numbers = array_of(data, states_[i].kind);
    double sum = states_[i].offset;
    for (const Number& number : states_[i].numbers) sum += number.factor * numbers[number.address];
    x(static_cast<Index>(i)) = sum;
  }
}

bool States::gives(State::Kind kind, int joint) const {
  const std::vector<int>& joints = (kind == State::Kind::position ? positions_ : velocities_).joints;
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

}  // namespace rehearse::mujoco
