#pragma once

#include <optional>

#include "rehearse/core/random.hpp"
#include "rehearse/lqr/problem.hpp"
#include "rehearse/policy/hand_over.hpp"

namespace rehearse::lqr {

/// The state in which the robot can stay for the highest reward, in the model's mean, and feedback that holds it there,
/// with the states in which to hand over to it (region.hpp). It is looked for from the start and from random angles,
/// and turns of joints in rad.
/// Random numbers come from `key`. nullopt: none was found. Any thread.
std::optional<policy::HandOver> find_goal(const Problem& problem, const StreamKey& key);

}  // namespace rehearse::lqr
