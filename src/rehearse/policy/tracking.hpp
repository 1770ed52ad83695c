#pragma once

#include <memory>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// Linear feedback about a state: u = action + gain · (x − state), moved into its bounds. Differences of angles are
/// taken the shorter way round.
struct FeedbackStage {
  Vector action;  // du
  Vector state;   // dx
  Matrix gain;    // du × dx
};

/// Time-varying linear feedback: step t has the t-th stage, and every step after the last but one has the last, which
/// holds the robot where the plan ends. At times between two steps actions are between those of both stages, so a robot
/// may call it more often. The result of trajectory optimisation (Li 2004). θ: the stages one after the other, each its
/// action, its state, its gain row by row. Throws InvalidInput if there are fewer than two stages.
std::shared_ptr<const Policy> make_tracking(const Task& task, Index stages);

/// The name of the tracking policy.
inline constexpr const char* kTracking = "tracking";

/// The numbers of θ that a stage takes.
Index numbers_of_stage(const Task& task);

/// Stages that take these actions (steps × du) whatever happens; the last ones are held.
std::vector<FeedbackStage> open_loop(const Task& task, const ConstMatrixView& actions);

/// θ of the policy that has these stages, and the stages of θ.
Vector to_theta(const std::vector<FeedbackStage>& stages);
std::vector<FeedbackStage> to_stages(const Task& task, const ConstVectorView& theta);

}  // namespace rehearse::policy
