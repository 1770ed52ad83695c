#pragma once
// The robot without its actuators, which are known: what a study is of.

#include "rehearse/core/task.hpp"

namespace rehearse::study {

/// The task of the robot's own states, whose actions act at once. Its functions are not to be called.
Task robot_alone(Task task);

/// The episode of the robot's own states, with what moved them for actions. actuators: of the task that it is of.
Episode robot_alone(Episode episode, const Actuators& actuators);

}  // namespace rehearse::study
