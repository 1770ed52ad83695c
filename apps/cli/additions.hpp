#pragma once

#include "rehearse/cli/cli.hpp"
#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::apps {

/// The catalogue with the robots and learners of a program of one's own. Throws InvalidInput if one of them is empty,
/// or has no name of its own.
experiment::Catalogue with_additions(experiment::Catalogue catalogue, const std::vector<RobotMaker>& robots,
                                     const std::vector<LearnerFamily>& learners);

}  // namespace rehearse::apps
