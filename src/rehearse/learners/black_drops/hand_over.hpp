#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/learners/black_drops/search_problem.hpp"
#include "rehearse/lqr/goal.hpp"

namespace rehearse::learners::black_drops {

/// The goal near which the policies of a trial hand over to feedback (lqr/goal.hpp); trial: its seed and number.
std::optional<policy::HandOver> find_goal(const lqr::Problem& problem, StreamKey trial);

/// A note on a trial whose policies do not hand over.
inline constexpr const char* kNoGoal =
    "no state was found in which feedback holds the robot: policies do not hand over";

/// A line for each option, or part of the task, that `search.hand_over` cannot go with.
std::vector<std::string> hand_over_violations(const SearchOptions& options, const Task& task);

}  // namespace rehearse::learners::black_drops
