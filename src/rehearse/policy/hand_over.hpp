#pragma once

#include <memory>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::policy {

/// Linear feedback near a state, and where "near" ends: it acts where (x − state)ᵀ shape (x − state) < 1. Differences
/// of angles are taken the shorter way round.
struct HandOver {
  FeedbackStage feedback;
  Matrix shape;  // dx × dx, symmetric
};

/// A policy that hands over to linear feedback near a goal: what brings the robot there need not hold it there. θ: that
/// of `elsewhere`, then the feedback's action, state and gain as of make_tracking, then the shape row by row.
std::shared_ptr<const Policy> make_hand_over(const Task& task, std::shared_ptr<const Policy> elsewhere);

/// The same with one feedback for all θ, which are those of `elsewhere`: what a search moves. Throws InvalidInput if
/// sizes are wrong.
std::shared_ptr<const Policy> with_hand_over(const Task& task, std::shared_ptr<const Policy> elsewhere,
                                             const HandOver& near);

/// The name of both.
inline constexpr const char* kHandOver = "hand-over";

/// θ of make_hand_over.
Vector to_theta(const ConstVectorView& elsewhere, const HandOver& near);

}  // namespace rehearse::policy
