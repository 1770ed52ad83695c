#pragma once
// Black-DROPS and its descendants: learn a dynamics model, search the policy in it by black-box optimisation, try it
// (Chatzilygeroudis 2017; Chatzilygeroudis 2018, Algorithm 1). The four learners differ in their model alone.

#include <memory>
#include <vector>

#include "rehearse/learners/black_drops/options.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::learners::black_drops {

/// Throws InvalidInput if an option is out of bounds, or a prior is needed and missing, or the reward is to be learned
/// and the first search, on the prior, has no initial_reward.
std::unique_ptr<Learner> make(Setting setting, Options options);

/// black-drops, black-drops-prior, gp-mi and mi.
std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::black_drops
