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

/// Use it to warn of states that are missing: what a step depends on that no state gives, a line each, such as
/// "velocity of joint 'knee'". A simulator begins every step with it as the keyframe has it. Throws InvalidInput.
std::vector<std::string> unseen(const ModelDescription& description);

/// Use it to warn of a model and a task that do not fit: actions whose bounds (du) are beyond what their actuators
/// take, and joints that a start (dx) has outside of their ranges, a line each. Throws InvalidInput.
std::vector<std::string> misfits(const ModelDescription& description, const std::vector<Interval>& bounds,
                                 const Vector& start);

}  // namespace rehearse::mujoco
