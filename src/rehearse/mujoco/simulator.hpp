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
/// time are kept. φ has the order of `parameters`. `change` throws InvalidInput where φ is not finite or makes no
/// model. Throws InvalidInput, all violations at once, where `parameters` have other names than the description's.
std::shared_ptr<const system::Simulator> make_simulator(SharedModel model, ParameterSpace parameters);

/// Use it to warn of a model and a task that do not fit. A simulator begins every step with what is unseen as the
/// keyframe has it. bounds: of the actions (du); start: dx.
Warnings warnings_of(const SharedModel& model, const std::vector<Interval>& bounds, const Vector& start);

}  // namespace rehearse::mujoco
