#pragma once
// PILCO (Deisenroth 2011): learn GPs of the dynamics, follow a Gaussian through a rollout in them in closed form,
// search the policy by the gradient of its expected return, try it. With a prior: GPs around those that PILCO learns on
// the prior (Cutler 2015), or around the prior itself (PI-REM, Saveriano 2017). docs/pilco.md.

#include <memory>
#include <vector>

#include "rehearse/learners/learner.hpp"
#include "rehearse/learners/pilco/options.hpp"

namespace rehearse::learners::pilco {

/// Throws InvalidInput if an option is out of bounds, the policy or the task's reward has no analytic moments, or a
/// prior is needed and missing.
std::unique_ptr<Learner> make(Setting setting, Options options);

/// pilco, pilco-prior and pi-rem.
std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::pilco
