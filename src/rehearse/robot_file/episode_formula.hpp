#pragma once

#include "rehearse/core/episode.hpp"
#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

/// A formula of a whole episode. It may use each state, and each definition of states, as NAME: its value at the end,
/// and as NAME_max, NAME_min and NAME_mean: of all states, the start's and the last. Throws InvalidInput where it is
/// wrong.
std::function<double(const Episode&)> episode_formula(const Robot& robot, const Formula& formula);

}  // namespace rehearse::robot_file
