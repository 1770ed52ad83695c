#pragma once
// The numbers that a policy sees, for the sources of this room.

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::check {

/// A line for each state that a policy sees as far too large or too small a number, or as one that hardly changes
/// beside its size. Policies that cannot be described have none. X: states that were met, a row each.
std::vector<std::string> notes_on_scales(const Task& task, const policy::Policy& policy, const Matrix& X);

}  // namespace rehearse::check
