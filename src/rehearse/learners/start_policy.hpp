#pragma once

#include <string>

#include "rehearse/learners/learner.hpp"

namespace rehearse::learners {

/// Throws InvalidInput if the policy that a run begins with lies outside of where policies are searched: the policy's
/// own box, else [−box, box], which is the value of this option.
void require_start_in_box(const Setting& setting, double box, const std::string& option);

}  // namespace rehearse::learners
