#pragma once

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::testing {

/// The laws of a policy, tried on random θ and states (around the task's start, and huge). Returns a line for each law
/// that is broken:
///
/// - actions are inside the task's bounds, for θ of any size;
/// - a row depends on that row of θ and of the states alone, to the bit, and on no memory of earlier calls;
/// - exactly `parameters()` columns of θ are read;
/// - a row whose state is all NaN gets NaN actions; a huge or infinite one gets actions inside the bounds or NaN.
std::vector<std::string> check_policy(const policy::Policy& policy, const Task& task, std::uint64_t seed = 1);

}  // namespace rehearse::testing
