#pragma once
// PILCO with priors (Cutler 2015): learning on the prior system, before the first trial on the robot.

#include "rehearse/learners/pilco/prior_knowledge.hpp"

namespace rehearse::learners::pilco {

/// PILCO on the setting's prior at its own parameters for as long as `options.prior`, which must be there, says; then
/// once more a model and a policy. Kept in the setting's store after each episode.
PriorKnowledge learn_on_prior(const Setting& setting, const Options& options);

}  // namespace rehearse::learners::pilco
