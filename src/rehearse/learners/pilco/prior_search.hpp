#pragma once
// PI-REM (Saveriano 2017): policy searches on the prior itself, before the first trial on the robot.

#include "rehearse/learners/pilco/prior_knowledge.hpp"

namespace rehearse::learners::pilco {

/// Policies for the setting's prior at its own parameters, one a search, each from a first policy of its own; as many
/// as `options.pi_rem`, which must be there, says. Kept in the setting's store after each search.
PriorKnowledge search_on_prior(const Setting& setting, const Options& options);

}  // namespace rehearse::learners::pilco
