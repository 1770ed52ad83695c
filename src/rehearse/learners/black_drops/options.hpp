#pragma once

#include "rehearse/core/options.hpp"
#include "rehearse/identification/kinds.hpp"
#include "rehearse/identification/learned_reward.hpp"
#include "rehearse/learners/black_drops/policy_search.hpp"

namespace rehearse::learners::black_drops {

/// The first trial without a prior.
struct FirstTrial {
  enum class Kind {
    actions,   // uniform in their bounds (PILCO, the authors' code)
    extremes,  // one bound or the other
    policy,    // θ uniform in its box (Chatzilygeroudis 2018, Algorithm 1)
  };
  Kind kind = Kind::actions;
  double hold_s = 0.2;    // an action is held so long (PILCO, the authors' code: one step)
  double cautious = 0.3;  // of a task with limits: random actions are in so much of their range, about its middle
  void fields(FieldVisitor& v);
};

/// A trial only confirms what a model that is sure predicts. So a search whose policy is not expected to solve the task
/// is repeated from other points, and policies that solve it are preferred to others, even of a higher return. Where
/// the task cannot say that it is solved, the search is repeated until its return is found again.
struct Retry {
  Index searches = 3;       // more than one, at most; 0: the policy of the highest return of one search (the paper)
  double tolerance = 0.05;  // of the highest return: where one that solves has less, the search goes on
  double uncertain_tolerance = 0.2;  // return that may be given up, as a fraction, for a policy that solves the task
                                     // where the model is uncertain, and for a new one where the best was tried; 0: no
  void fields(FieldVisitor& v);
};

/// Options of the four learners; they differ in their model alone.
struct Options {
  identification::Kind model = identification::GpMi{};
  identification::RewardOptions reward;
  SearchOptions search;
  FirstTrial first_trial;
  bool start_from_best = true;      // one descent starts from the best policy observed; the authors' code
  bool start_from_examples = true;  // and one from each example that the policy brings; the paper: none, it has
                                    // no prior on policies
  Retry retry;
  bool success_test = true;   // policies may be chosen by the task's test of success, where it gives one; false: by
                              // their return alone (the paper)
  Index prior_searches = 1;   // searches on the prior before the first trial, each from the best of the one before
                              // (the authors' code: 2)
  double prior_variance = 0;  // predicted before there are data (the authors' code: 1)
  void fields(FieldVisitor& v);
};

}  // namespace rehearse::learners::black_drops
