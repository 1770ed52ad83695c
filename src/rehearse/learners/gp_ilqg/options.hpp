#pragma once

#include "rehearse/core/options.hpp"
#include "rehearse/identification/kinds.hpp"
#include "rehearse/lqr/step_costs.hpp"

namespace rehearse::learners::gp_ilqg {

/// Options of the search for a trial's plan.
struct PlanSearch {
  /// Plans minimise minus the reward; minus its logarithm; or first the latter, which is flat nowhere, then the
  /// former.
  enum class Cost { linear, logarithmic, both };

  double plan_s = 0;  // seconds that are planned, what follows is held; 0: the whole episode
  Cost cost = Cost::both;
  double first_costs = 1;     // fraction of the task's costs in the first iterations
  double action_cost = 1e-3;  // of an action at its bound, for a step, beside the reward
  double uncertainty = 1;     // weight of the cost of the model's variance; 0: plans use the mean alone
  bool hold = true;           // plans end with feedback of an infinite horizon, where that is better
  bool soften = true;         // plans with less feedback compete where noise of measurements shakes the actions
  Index starts = 16;          // random actions that plans begin with, beside the last plan
  double start_size = 0.3;    // fraction of their range, about its middle, for such actions
  double start_hold_s = 0.2;  // how long such an action is held
  Index first_iterations = 60;
  Index finalists = 4;  // plans that are improved further
  Index iterations = 200;
  Index selection = 100;   // simulated episodes that plans are compared in, with the model's uncertainty
  double tolerance = 0.2;  // of the highest return: a plan that solves the task more often may have so much less
  void fields(FieldVisitor& v);
};

struct Options {
  bool identify = false;  // the prior's parameters are learned with the GPs, as GP-MI does
  identification::GpMi model;
  PlanSearch search;
  bool success_test = true;  // plans may be chosen by the task's test of success
  Options();
  void fields(FieldVisitor& v);
};

}  // namespace rehearse::learners::gp_ilqg
