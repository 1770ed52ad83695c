#pragma once

#include <optional>

#include "rehearse/core/options.hpp"
#include "rehearse/learners/pilco/model.hpp"
#include "rehearse/learners/pilco/policy_search.hpp"

namespace rehearse::learners::pilco {

/// Options of PILCO's learning on the prior (Cutler 2015).
struct PriorPhaseOptions {
  Index episodes = 40;  // at most; Chatzilygeroudis 2018, on the pendubot
  // The phase ends after so many episodes in a row that taught nothing: they returned what was predicted or more, and
  // no more than one before, within 2 %. 0: it does not end so (Chatzilygeroudis)
  Index settled = 3;
  Index inducing = 300;  // at most so many points of what was learned are the means of the GPs on the robot (PILCO)
  void fields(FieldVisitor& v);
};

/// Options of PI-REM (Saveriano 2017): the prior itself is the mean of the GPs, and the first policy is made for it.
struct PiRemOptions {
  moments::Through through = moments::Through::linearised;
  bool identify = false;   // GP-MI's parameters of the prior, found anew before each trial; Saveriano: as given
  Index searches = 20;     // on the prior alone, each from a first policy of its own: they cost little, and end at
                           // different local optima
  double start_std = 0.1;  // of each state of the start of these searches, at least: the prior is wrong, and a policy
                           // that does well from a point alone is lost as soon as the robot is elsewhere
  void fields(FieldVisitor& v);
};

struct Options {
  ModelOptions model;
  SearchOptions search;
  bool success_test = true;  // searches begin anew until the task's test of success, where it gives one, is passed;
                             // false: in every trial
  double first_trial_hold_s = 0;           // a random action of the first trial is held so long; PILCO: one step
  std::optional<PriorPhaseOptions> prior;  // PILCO learns on the prior first, and begins with that; empty: without one
  std::optional<PiRemOptions> pi_rem;      // GPs are around the prior; at most one of the two
  void fields(FieldVisitor& v);
};

}  // namespace rehearse::learners::pilco
