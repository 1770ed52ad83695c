#pragma once
// Linear feedback near a goal, in texts of exported policies.

#include <string>

#include "rehearse/policy/exported.hpp"

namespace rehearse::policy {

/// Lines that replace `action`, which the rest of the policy has computed, where the state is near; empty if the policy
/// hands over to no feedback. name: that of the function.
std::string near_in_c(const Exported& exported, const std::string& name);

/// The same of `u`, for all rows of `x`.
std::string near_in_numpy(const Exported& exported);

}  // namespace rehearse::policy
