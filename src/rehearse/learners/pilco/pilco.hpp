#pragma once
// PILCO (Deisenroth 2011): learn GPs of the dynamics, follow a Gaussian through a rollout in them in closed form,
// search the policy by the gradient of its expected return, try it. docs/pilco.md.

#include <memory>
#include <optional>
#include <vector>

#include "rehearse/learners/learner.hpp"
#include "rehearse/learners/pilco/model.hpp"
#include "rehearse/learners/pilco/policy_search.hpp"

namespace rehearse::learners::pilco {

inline constexpr Index kPriorEpisodes = 40;  // Chatzilygeroudis 2018, on the pendubot

struct Options {
  ModelOptions model;
  SearchOptions search;
  double first_trial_hold_s = 0;        // a random action of the first trial is held so long; PILCO: one step
  std::optional<Index> prior_episodes;  // PILCO learns on the prior for so many, and begins with that (Cutler 2015);
                                        // empty: without a prior
  void fields(FieldVisitor& v);
};

/// Throws InvalidInput if an option is out of bounds, the policy or the task's reward has no analytic moments, or a
/// prior is needed and missing.
std::unique_ptr<Learner> make(Setting setting, Options options);

/// pilco and pilco-prior.
std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::pilco
