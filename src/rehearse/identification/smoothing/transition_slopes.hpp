#pragma once

#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::identification {

/// The derivatives of the next state's mean with respect to each state (dx matrices, each n × dx) at the rows of a data
/// set, by differences of a thousandth of the states' spread. A state that never moves is taken to move itself alone.
std::vector<Matrix> transition_slopes(const dynamics::DynamicsModel& model, const Dataset& rows);

}  // namespace rehearse::identification
