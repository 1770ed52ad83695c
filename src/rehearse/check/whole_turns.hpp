#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rehearse/core/task.hpp"

namespace rehearse::check {

/// A line for the reward, the end and the success test, each with the angle that they see otherwise after a whole turn.
/// Models and policies see sine and cosine of an angle, the same after each turn, and a robot may come to its goal
/// either way round. The states that are tried have angles anywhere, and the other states of the start.
std::vector<std::string> where_turns_count(const Task& task, std::uint64_t seed);

}  // namespace rehearse::check
