#pragma once
// Black-DROPS and its descendants: learn a dynamics model, search the policy in it by black-box optimisation, try it
// (Chatzilygeroudis 2017; Chatzilygeroudis 2018, Algorithm 1). The four learners differ in their model alone.

#include <memory>
#include <vector>

#include "rehearse/identification/learn.hpp"
#include "rehearse/identification/learned_reward.hpp"
#include "rehearse/learners/black_drops/policy_search.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::learners::black_drops {

/// What the first trial without a prior does.
struct FirstTrial {
  enum class Kind {
    actions,   // uniform in their bounds (PILCO, the authors' code)
    extremes,  // one bound or the other
    policy,    // θ uniform in its box (Chatzilygeroudis 2018, Algorithm 1)
  };
  Kind kind = Kind::actions;
  double hold_s = 0.2;  // an action is held so long (PILCO, the authors' code: one step)
  void fields(FieldVisitor& v);
};

/// A search that follows the mean predictions, before the one that meets the model's doubts. It is not lost in noise,
/// and costs a fraction where the data are many. Its policy is tried at once if the doubts cost it next to nothing.
struct Scouting {
  Index policies = 4;       // best ones found, from which descents of the other search start; 0: none (the paper)
  double tolerance = 0.02;  // of the return that the means promise: what the doubts may cost
  void fields(FieldVisitor& v);
};

/// Where the model is sure, a search whose policy it does not expect to solve the task is repeated from other points: a
/// trial would only confirm it. A policy that solves is preferred to others, even of a higher return.
struct Insistence {
  Index searches = 3;       // more than one, at most; 0: the policy of the highest return, whatever it does (the paper)
  double tolerance = 0.05;  // of the highest return: where one that solves has less, the search goes on
  double doubtful_tolerance =
      0.2;  // what a policy that solves may cost where the model has doubts; 0: none is preferred
  void fields(FieldVisitor& v);
};

/// A search that meets the model's doubts ends near what is known. Where it leads no further, another follows the mean
/// predictions alone, and its policy is tried if it promises much: the doubts may be unfounded, and if not, the trial
/// resolves them. Fractions of the best return seen.
struct Exploration {
  double gain = 0.1;      // a promise of less is no progress; 0: never explore (the paper)
  double promise = 0.15;  // that is worth a trial
  void fields(FieldVisitor& v);
};

struct Options {
  identification::Kind model = identification::GpMi{};
  identification::RewardOptions reward;
  SearchOptions search;
  FirstTrial first_trial;
  bool start_from_best = true;      // one descent starts from the best policy observed; the authors' code
  bool start_from_last = false;     // and one from the last policy tried: its trial told most of where it fails
  bool start_from_examples = true;  // and one from each example that the policy brings; the paper: none, it has
                                    // no prior on policies
  Exploration explore;
  Scouting scout;
  Insistence insist;
  bool success_test = true;   // policies may be chosen by the task's test of success, where it gives one; false: by
                              // their return alone (the paper), then insist has no effect
  Index carried = 3;          // and so many from the best other policies of the search before
  Index prior_searches = 1;   // searches on the prior before the first trial, each from the best of the one before
                              // (the authors' code: 2)
  double prior_variance = 0;  // predicted before there are data (the authors' code: 1)
  void fields(FieldVisitor& v);
};

/// Throws InvalidInput if an option is out of bounds, or a prior is needed and missing, or the reward is to be learned
/// and the first search, on the prior, has no initial_reward.
std::unique_ptr<Learner> make(Setting setting, Options options);

/// black-drops, black-drops-prior, gp-mi and mi.
std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::black_drops
