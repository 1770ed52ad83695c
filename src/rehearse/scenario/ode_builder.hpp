#pragma once

#include <memory>
#include <string>

#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::scenario {

/// Use it for a robot that is one equation and has no options of its own; builder.hpp takes other options. Options are
/// `plant.NAME` for each parameter of the plant, `measurement_noise`, `substeps`, `evaluations` and those of the
/// policy; `options` has their defaults. An empty policy_scale is 1 for every input. Throws InvalidInput as the
/// scenario does.
std::unique_ptr<ScenarioBuilder> make_ode_builder(std::string summary, OdeScenario parts,
                                                  const OdeOptions& options = {});

}  // namespace rehearse::scenario
