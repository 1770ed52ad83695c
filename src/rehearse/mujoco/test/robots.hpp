#pragma once
// Models of test/data, and their equations of motion.

#include <cmath>
#include <string>

#include "rehearse/core/errors.hpp"
#include "rehearse/mujoco/description.hpp"
#include "rehearse/mujoco/simulator.hpp"
#include "rehearse/system/ode.hpp"

namespace rehearse::mujoco {

constexpr double kControlStep = 0.05;

inline std::string data_file(const std::string& name) { return std::string(TEST_DATA_DIR "/") + name; }

/// State: angle, speed. Action: torque.
inline ModelDescription pendulum_model() {
  ModelDescription model;
  model.path = data_file("pendulum.xml");
  model.dt_s = kControlStep;
  model.states = {{"angle", State::Kind::position, {{"hinge"}}, 0}, {"rate", State::Kind::velocity, {{"hinge"}}, 0}};
  model.actions = {{"motor"}};
  return model;
}

struct PendulumNumbers {
  double mass = 1, inertia = 0.08, centre = 0.5, gravity = 9.82;
  double armature = 0, damping = 0, stiffness = 0, friction = 0, gear = 1, push = 0;
};

inline system::Ode pendulum_equation(const PendulumNumbers& n = {}) {
  return [n](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) {
    const double about_hinge = n.inertia + n.mass * n.centre * n.centre + n.armature;
    const double lost = n.damping * x(1) + n.friction * std::copysign(1.0, x(1));
    dxdt(0) = x(1);
    dxdt(1) = (n.gear * (u(0) + n.push) - lost - n.stiffness * x(0) - n.mass * n.gravity * n.centre * std::sin(x(0))) /
              about_hinge;
  };
}

/// State: both angles, measured from the vertical, and their speeds. Action: torque between the links.
inline ModelDescription acrobot_model(const std::string& file = "acrobot.xml") {
  ModelDescription model;
  model.path = data_file(file);
  model.dt_s = kControlStep;
  model.states = {{"a1", State::Kind::position, {{"shoulder"}}, 0},
                  {"a2", State::Kind::position, {{"shoulder"}, {"elbow"}}, 0},
                  {"da1", State::Kind::velocity, {{"shoulder"}}, 0},
                  {"da2", State::Kind::velocity, {{"shoulder"}, {"elbow"}}, 0}};
  model.actions = {{"motor"}};
  return model;
}

inline system::Ode acrobot_equation(double length = 1) {
  return [length](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) {
    constexpr double m1 = 1.2, m2 = 0.8, c1 = 0.4, c2 = 0.5, i1 = 0.09, i2 = 0.07, g = 9.82;
    const double h = m2 * length * c2, turn = x(0) - x(1), a12 = h * std::cos(turn);
    const double a11 = i1 + m1 * c1 * c1 + m2 * length * length, a22 = i2 + m2 * c2 * c2;
    const double push1 = -u(0) - h * std::sin(turn) * x(3) * x(3) - (m1 * c1 + m2 * length) * g * std::sin(x(0));
    const double push2 = u(0) + h * std::sin(turn) * x(2) * x(2) - m2 * c2 * g * std::sin(x(1));
    const double determinant = a11 * a22 - a12 * a12;
    dxdt << x(2), x(3), (a22 * push1 - a12 * push2) / determinant, (a11 * push2 - a12 * push1) / determinant;
  };
}

/// The state that an adaptive integration reaches in a control step.
inline Vector by_equation(const system::Ode& equation, const Vector& x, const Vector& u) {
  return system::integrate_adaptive(equation, x, u, Vector(), kControlStep);
}

/// The description's parameters, fixed where they start.
inline ParameterSpace parameter_space(const ModelDescription& description) {
  std::vector<Parameter> parameters;
  for (const ModelParameter& each : description.parameters)
    parameters.push_back(Parameter::fixed(each.name, each.value, each.unit));
  return ParameterSpace(parameters);
}

inline std::shared_ptr<const system::Simulator> simulator_of(const ModelDescription& model) {
  return make_simulator(compile(model), parameter_space(model));
}

/// The state that a model reaches in a control step, its parameters where they start.
inline Vector by_model(const ModelDescription& model, const Vector& x, const Vector& u) {
  Matrix dX(1, x.size());
  simulator_of(model)->change(x.transpose(), u.transpose(), parameter_space(model).values(), dX);
  return x + dX.row(0).transpose();
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The complaint of make(…), "" if there is none.
template <class Make>
std::string complaint_of(Make make) {
  try {
    make();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace rehearse::mujoco
