#include "python/bindings/catalogue.hpp"

#include <string>

#include <pybind11/stl.h>

#include "apps/catalogue.hpp"
#include "apps/cli/commands.hpp"
#include "python/bindings/robot.hpp"
#include "rehearse/experiment/preset.hpp"

namespace rehearse::python {
namespace {

py::dict known() {
  const experiment::Catalogue catalogue = apps::catalogue();
  py::dict robots, learners, presets, missing;
  for (const auto& robot : catalogue.scenario_builders())
    robots[py::str(robot->name())] = py::make_tuple(robot->summary(), robot->prior_names());
  for (const auto& learner : catalogue.learner_builders()) learners[py::str(learner->name())] = learner->summary();
  for (const auto& preset : catalogue.presets)
    presets[py::str(preset.name)] = experiment::Preset(preset.text, preset.name).title();
  for (const experiment::NotBuilt& each : catalogue.not_built) missing[py::str(each.name)] = each.reason;
  return py::dict(py::arg("robots") = robots, py::arg("learners") = learners, py::arg("presets") = presets,
                  py::arg("missing") = missing);
}

}  // namespace

void add_catalogue(py::module_& module) {
  using namespace py::literals;
  module.def("known", &known);
  module.def(
      "entry", [](const Robot& robot, const std::string& name) { return apps::entry_json(robot.to_look(), name); },
      "robot"_a, "name"_a);
}

}  // namespace rehearse::python
