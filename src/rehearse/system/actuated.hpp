#pragma once
// Plants and simulators of a robot's own states, with its actuators in front (core/actuators.hpp).

#include <memory>

#include "rehearse/core/actuators.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::system {

/// A simulator of the states with their memory; the robot's gets the actions that move the robot.
std::shared_ptr<const Simulator> with_actuators(std::shared_ptr<const Simulator> robot, Actuators actuators);

/// A plant that measures the memory of `task`, too. `own`: the actuators that the plant has, of no own states, which a
/// learner need not know; none for a robot that has them by itself.
std::unique_ptr<Plant> with_actuators(std::unique_ptr<Plant> robot, Actuators task, Actuators own);

}  // namespace rehearse::system
