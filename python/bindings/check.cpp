#include "python/bindings/check.hpp"

#include <optional>
#include <utility>

#include <pybind11/stl.h>

#include "python/bindings/work.hpp"
#include "rehearse/check/complaints.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/participants.hpp"

namespace rehearse::python {
namespace {

struct Found {
  std::vector<std::string> states, limits;  // names; the robot's own states
  check::Tried tried;
};

/// shown: a page is to show how the plant moves.
Found check(const Robot& robot, const std::string& name, bool plant, bool shown) {
  std::optional<Found> found;
  work_with(robot, {}, [&](const Robot& own, const experiment::RunOptions& options) {
    const experiment::Catalogue catalogue = own.catalogue();
    scenario::Scenario scenario = catalogue.scenario_or_throw(name)->build();
    if (!plant) scenario.make_plant = nullptr;
    if (shown && !scenario.make_plant)
      throw InvalidInput(
          "out: there is no plant whose motion it could show; in a copy, make the dynamics of a prior the plant");
    if (scenario.require_ready)
      scenario.require_ready(plant ? scenario::PlantUse::driven : scenario::PlantUse::left_alone);
    own.try_out(scenario);
    std::vector<std::string> states;
    for (Index i = 0; i < scenario.task.actuators().own_states(); ++i)
      states.push_back(scenario.task.states[static_cast<std::size_t>(i)].name);
    std::vector<std::string> limits;
    for (const Limit& limit : scenario.task.limits) limits.push_back(limit.name);
    found = {std::move(states), std::move(limits), check::try_out(scenario, *experiment::evaluator_of(options))};
    const std::vector<std::string> faults = scenario.faults ? scenario.faults() : std::vector<std::string>();
    found->tried.notes.insert(found->tried.notes.end(), faults.begin(), faults.end());
  });
  return *found;
}

/// Empty where there are no values, since there was no step.
py::dict by_state(const std::vector<std::string>& states, const Vector& values) {
  py::dict dict;
  for (std::size_t i = 0; i < states.size() && values.size() > 0; ++i)
    dict[py::str(states[i])] = values(static_cast<Index>(i));
  return dict;
}

/// A prior that plays the robot has no errors: the steps are its own.
py::list of_priors(const Found& found) {
  using namespace py::literals;
  py::list priors;
  for (const check::PriorTried& prior : found.tried.priors) {
    const bool plays = found.tried.played && priors.empty();
    priors.append(py::dict("name"_a = prior.name, "errors"_a = plays ? py::dict() : by_state(found.states, prior.error),
                           "failed"_a = prior.failed, "rows_per_s"_a = prior.rows_per_s, "notes"_a = prior.notes));
  }
  return priors;
}

}  // namespace

void add_check(py::module_& module) {
  using namespace py::literals;
  module.def(
      "check",
      [](const Robot& robot, const std::string& name, bool plant, bool shown) {
        const Found found = check(robot, name, plant, shown);
        py::dict broke;
        for (std::size_t i = 0; i < found.limits.size(); ++i) broke[py::str(found.limits[i])] = found.tried.limits[i];
        return py::dict("steps"_a = found.tried.steps, "episodes"_a = found.tried.episodes,
                        "played"_a = found.tried.played, "plant_failed"_a = found.tried.end.has_value(),
                        "ended"_a = found.tried.ended, "broke"_a = broke,
                        "changes"_a = by_state(found.states, found.tried.change), "priors"_a = of_priors(found),
                        "notes"_a = found.tried.notes, "complaints"_a = check::complaints(found.tried));
      },
      "robot"_a, "name"_a, "plant"_a, "shown"_a);
}

}  // namespace rehearse::python
