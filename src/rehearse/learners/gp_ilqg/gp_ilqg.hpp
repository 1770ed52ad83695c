#pragma once

#include <memory>
#include <vector>

#include "rehearse/learners/gp_ilqg/options.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::learners::gp_ilqg {

/// GP-ILQG (Lee 2017): iterative LQG on the mean of a prior and GPs, with the GPs' variance as noise that depends on
/// state and actions. The policy is linear feedback that varies with time (policy/tracking.hpp). Use it where the prior
/// is roughly right and trials start from the same state. Throws InvalidInput where the task has limits.
std::unique_ptr<Learner> make(Setting setting, Options options);

std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::gp_ilqg
