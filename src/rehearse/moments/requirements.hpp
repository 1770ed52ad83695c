#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::moments {

/// What of a task or a policy has no analytic moments, a line each. who: needs them; otherwise: what else to choose.
std::vector<std::string> without_moments(const Task& task, const policy::Policy& policy, std::string_view who,
                                         std::string_view otherwise);

}  // namespace rehearse::moments
