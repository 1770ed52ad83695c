#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/parameters.hpp"
#include "rehearse/mujoco/description.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::mujoco {

/// Use it for priors whose dynamics is a model file. A row begins at its states, whatever else as ModelDescription
/// says, and is NaN where the simulation diverges. A call has a copy of the model to itself: as many as there are at a
/// time are kept. φ has the order of `parameters`, which must have the description's names. `change` throws
/// InvalidInput where φ is not finite or makes no model. Throws InvalidInput, all violations at once, where the file or
/// the description is wrong.
std::shared_ptr<const system::Simulator> make_simulator(const ModelDescription& description, ParameterSpace parameters);

/// The description's parameters, fixed where they start.
ParameterSpace parameter_space(const ModelDescription& description);

/// Use it to warn of a model and a task that do not fit. A simulator begins every step with what is unseen as the
/// keyframe has it. bounds: of the actions (du); start: dx. Throws InvalidInput.
Warnings warnings_of(const ModelDescription& description, const std::vector<Interval>& bounds, const Vector& start);

}  // namespace rehearse::mujoco
