#pragma once

#include <optional>

#include "rehearse/experiment/past_run.hpp"
#include "rehearse/policy/exported.hpp"

namespace rehearse::experiment {

/// The policy of a trial of a run, or of the best one, to be taken along: with what it answers in states that the robot
/// was in during that trial. Throws InvalidInput if there is no such trial, or its policy cannot be described.
policy::Exported exported_policy(const PastRun& run, std::optional<Index> trial = {});

}  // namespace rehearse::experiment
