#pragma once

#include <optional>

#include "rehearse/core/random.hpp"
#include "rehearse/lqr/problem.hpp"
#include "rehearse/policy/hand_over.hpp"

namespace rehearse::lqr {

/// Feedback with the states in which it is to act.
struct Region {
  policy::HandOver hand_over;
  double log_volume = 0;  // of these states, in the units of the task
};

/// Feedback that holds the robot about a state that stays, with the largest region that is found from which it brings
/// the robot back. Regions are { x : (x − x*)ᵀ S (x − x*) < level }, with S a regulator's cost to go. A region counts
/// if from 95 % of the states on its surface the robot comes back in the model's mean, with actions within their
/// bounds: in half an episode, or if there is no such region in a whole one, to a twentieth of the level and of the
/// reward that is lost by not being at the goal. The level is found by trying (Tedrake 2010 proves such regions; here
/// states are drawn), the weights of the states by coordinate search. Random numbers come from `key`. nullopt: there is
/// none.
std::optional<Region> widest_region(const Problem& problem, const Vector& state, const Vector& action,
                                    const StreamKey& key);

}  // namespace rehearse::lqr
