#pragma once

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"

namespace rehearse {

/// The largest number that a robot may give: beyond are codes of errors, and sums that overflow.
inline constexpr double kLargestGiven = 1e12;

/// A line for each part of an episode that does not fit a task: sizes, and numbers that are not finite. Episodes of any
/// length fit, without a step too.
std::vector<std::string> misfits(const Episode& episode, const Task& task);

/// Throws InvalidInput with these lines.
void require_fit(const Episode& episode, const Task& task);

}  // namespace rehearse
