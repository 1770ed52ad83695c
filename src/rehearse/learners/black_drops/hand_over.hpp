#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/learners/black_drops/choice.hpp"
#include "rehearse/lqr/goal.hpp"

namespace rehearse::learners::black_drops {

/// The goal near which the policies of a trial hand over to feedback (lqr/goal.hpp); trial: its seed and number.
std::optional<policy::HandOver> find_goal(const lqr::Problem& problem, StreamKey trial);

/// True if the feedback acts from the start on. It may then decide the whole trial: a search of the policy elsewhere
/// would have nothing to move.
bool acts_at_start(const policy::HandOver& goal, const Task& task);

/// Makes a policy with such feedback the choice unless the choice, which is searched for without it, does better: it is
/// safer, or solves the task more surely, or else earns more. feedback: searches with the feedback. Returns whether it
/// did.
bool prefer_feedback(TrialSearches& feedback, TrialSearches& searches, Choice& choice);

/// Notes on a trial whose policies do not hand over.
inline constexpr const char* kNoGoal =
    "no state was found in which feedback holds the robot: policies do not hand over";
inline constexpr const char* kHeldAtStart =
    "feedback would hold the robot where it starts, and a policy without it does better: it does not hand over";

/// A line for each option, or part of the task, that `search.hand_over` cannot go with.
std::vector<std::string> hand_over_violations(const SearchOptions& options, const Task& task);

}  // namespace rehearse::learners::black_drops
