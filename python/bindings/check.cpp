#include "python/bindings/check.hpp"

#include <optional>
#include <utility>

#include <pybind11/stl.h>

#include "python/bindings/work.hpp"
#include "rehearse/check/complaints.hpp"

namespace rehearse::python {
namespace {

struct Found {
  std::vector<std::string> states, limits;  // names; the robot's own states
  check::Tried tried;
};

Found check(const Robot& robot, const std::string& name, bool plant) {
  std::optional<Found> found;
  work_with(robot, {}, [&](const Robot& own, const experiment::RunOptions& options) {
    const experiment::Catalogue catalogue = own.catalogue();
    scenario::Scenario scenario = catalogue.scenario_or_throw(name)->build();
    if (!plant) scenario.make_plant = nullptr;
    if (scenario.require_ready)
      scenario.require_ready(plant ? scenario::PlantUse::driven : scenario::PlantUse::left_alone);
    own.try_out(scenario);
    std::vector<std::string> states;
    for (Index i = 0; i < scenario.task.actuators().own_states(); ++i)
      states.push_back(scenario.task.states[static_cast<std::size_t>(i)].name);
    std::vector<std::string> limits;
    for (const Limit& limit : scenario.task.limits) limits.push_back(limit.name);
    const auto stoppable = make_stoppable(options.evaluator, options.stop);
    found = {std::move(states), std::move(limits), check::try_out(scenario, *stoppable)};
  });
  return *found;
}

py::dict by_state(const std::vector<std::string>& states, const Vector& values) {
  py::dict dict;
  for (std::size_t i = 0; i < states.size(); ++i) dict[py::str(states[i])] = values(static_cast<Index>(i));
  return dict;
}

}  // namespace

void add_check(py::module_& module) {
  using namespace py::literals;
  module.def(
      "check",
      [](const Robot& robot, const std::string& name, bool plant) {
        const Found found = check(robot, name, plant);
        py::list priors;
        for (const check::PriorTried& prior : found.tried.priors)
          priors.append(py::dict("name"_a = prior.name, "errors"_a = by_state(found.states, prior.error),
                                 "failed"_a = prior.failed, "rows_per_s"_a = prior.rows_per_s,
                                 "notes"_a = prior.notes));
        py::dict broke;
        for (std::size_t i = 0; i < found.limits.size(); ++i) broke[py::str(found.limits[i])] = found.tried.limits[i];
        return py::dict("steps"_a = found.tried.steps, "episodes"_a = found.tried.episodes,
                        "ended"_a = found.tried.ended, "broke"_a = broke,
                        "changes"_a = by_state(found.states, found.tried.change), "priors"_a = priors,
                        "notes"_a = found.tried.notes, "complaints"_a = check::complaints(found.tried));
      },
      "robot"_a, "name"_a, "plant"_a);
}

}  // namespace rehearse::python
