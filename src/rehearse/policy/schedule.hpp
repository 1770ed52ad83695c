#pragma once

#include <memory>
#include <vector>

#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// Open loop: the action of step t is the t-th of θ, moved into its bounds. θ: the first action of every step, then the
/// second, … After the last step the last actions are held. Throws InvalidInput if dt_s or steps is not positive, or
/// there are no bounds.
std::shared_ptr<const Policy> make_schedule(std::vector<Interval> bounds, double dt_s, Index steps);

}  // namespace rehearse::policy
