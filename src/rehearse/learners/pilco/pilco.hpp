#pragma once
// PILCO (Deisenroth 2011): learn GPs of the dynamics, follow a Gaussian through a rollout in them in closed form,
// search the policy by the gradient of its expected return, try it. docs/pilco.md.

#include <memory>
#include <vector>

#include "rehearse/learners/learner.hpp"
#include "rehearse/learners/pilco/model.hpp"
#include "rehearse/learners/pilco/policy_search.hpp"

namespace rehearse::learners::pilco {

struct Options {
  ModelOptions model;
  SearchOptions search;
  double first_trial_hold_s = 0;  // a random action of the first trial is held so long; PILCO: one step
  void fields(FieldVisitor& v);
};

/// Throws InvalidInput if an option is out of bounds, or the policy or the task's reward has no analytic moments.
std::unique_ptr<Learner> make(Setting setting, Options options);

/// pilco.
std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::pilco
