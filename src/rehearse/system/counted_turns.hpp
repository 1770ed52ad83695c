#pragma once

#include <memory>

#include "rehearse/core/turns.hpp"
#include "rehearse/system/plant.hpp"

namespace rehearse::system {

/// The plant, whose angles may be measured within one turn: turns are counted on, so that no angle jumps. A plant that
/// simulates needs it not, since its own state goes on.
std::unique_ptr<Plant> with_turns_counted(std::unique_ptr<Plant> robot, Turns turns);

}  // namespace rehearse::system
