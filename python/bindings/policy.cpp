#include "python/bindings/policy.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings/interruption.hpp"
#include "python/bindings/robot.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::python {

constexpr Index kRowsOfTheta = 256;  // each has its own θ: more of them take longer to write than to use

py::array_t<double> Policy::act(const py::array_t<double, py::array::f_style | py::array::forcecast>& states,
                                double time_s) const {
  const auto dx = static_cast<Index>(exported_.states.size());
  const bool one = states.ndim() == 1;
  if (states.ndim() < 1 || states.ndim() > 2 || states.shape(one ? 0 : 1) != dx)
    throw InvalidInput(fmt::format("states must be an array of {0} numbers, or n × {0}: {1}", dx,
                                   fmt::join(exported_.states | std::views::transform(&StateVariable::name), ", ")));
  const Index rows = one ? 1 : states.shape(0);
  const ConstMatrixView X = Matrix::Map(states.data(), rows, dx);
  Matrix U(rows, policy_->actions());
  {
    const Unlocked unlocked;
    const Matrix Theta = exported_.theta.transpose().replicate(std::min(rows, kRowsOfTheta), 1);
    for (Index first = 0; first < rows; first += kRowsOfTheta) {
      const Index some = std::min(kRowsOfTheta, rows - first);
      policy_->act(Theta.topRows(some), X.middleRows(first, some), time_s, U.middleRows(first, some));
    }
    exported_.actuators.command(X, U);
  }
  for (Index row = 0; row < rows; ++row)  // as what is exported answers
    if (!std::isfinite(time_s) || !X.row(row).allFinite()) U.row(row).setConstant(kNaN);
  if (one) return to_vector(U.row(0).transpose());
  return to_array(U);
}

Matrix Policy::remember(const Matrix& states, const Matrix& actions) const {
  const Actuators& actuators = exported_.actuators;
  Matrix next = states;
  actuators.remember(states, actions, next);
  return next.rightCols(actuators.memory());
}

Policy Policy::with_theta(const Vector& theta) const {
  policy::Exported other = policy::with_theta(exported_, *policy_, theta);
  other.origin.total_reward.reset();
  return {policy_, std::move(other)};
}

namespace {

/// Options of learners have no effect on a policy.
void require_of_robot(const experiment::Catalogue& catalogue, const std::string& scenario,
                      const learners::OptionTexts& options) {
  const auto builder = catalogue.scenario(scenario);
  if (!builder) return;  // resolving it says why
  std::vector<std::string> known;
  for (const auto& [name, text] : list_fields([&](FieldVisitor& v) { builder->fields(v); })) {
    known.push_back(name);
    known.push_back("scenario." + name);
  }
  Violations violations;
  for (const auto& [key, text] : options)
    violations.require(is_among(key, known), experiment::unknown_option(key, known, "a robot"));
  violations.throw_if_any();
}

/// The policy that a robot's learners search for, at θ; no θ: zeros.
Policy policy_for(const Robot& robot, const std::string& scenario,
                  const std::vector<std::pair<std::string, std::string>>& options, const std::optional<Vector>& theta) {
  const experiment::Catalogue catalogue = robot.to_look();
  require_of_robot(catalogue, scenario, options);
  const experiment::Resolved resolved = experiment::resolve(
      catalogue, {.scenario = scenario, .learner = "black-drops", .options = options});  // needs no prior
  const auto& policy = resolved.scenario.policy;
  const Task& task = resolved.scenario.task;
  const policy::Answers asked{.states = task.start_mean.transpose(), .times_s = Vector::Zero(1), .actions = {}};
  return {policy, policy::make_exported({.robot = scenario, .learner = "a program of its own"}, task, *policy,
                                        theta.value_or(Vector::Zero(policy->parameters())), asked)};
}

}  // namespace

void add_policy(py::module_& module) {
  py::class_<Policy>(module, "Policy")
      .def("act", &Policy::act, py::arg("states"), py::arg("time_s") = 0.0)
      .def("with_theta", &Policy::with_theta, py::arg("theta"))
      .def("start", [](const Policy& p) { return p.exported().actuators.start(); })
      .def("remember", &Policy::remember, py::arg("states"), py::arg("actions"))
      .def_property_readonly("theta", [](const Policy& p) { return p.exported().theta; })
      .def_property_readonly("kind", [](const Policy& p) { return p.exported().kind; })
      .def_property_readonly("trial", [](const Policy& p) { return p.exported().origin.trial; })
      .def_property_readonly("dt_s", [](const Policy& p) { return p.exported().dt_s; })
      .def("to_c",
           [](const Policy& p, const std::string& name) { return to_c(p.exported(), policy::identifier(name)); })
      .def("to_json", [](const Policy& p) { return to_json(p.exported()); })
      .def("to_numpy", [](const Policy& p) { return to_numpy(p.exported()); });
  module.def("policy_for", &policy_for, py::arg("robot"), py::arg("scenario"), py::arg("options"), py::arg("theta"));
}

}  // namespace rehearse::python
