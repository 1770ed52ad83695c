#include "rehearse/learners/gp_ilqg/options.hpp"

namespace rehearse::learners::gp_ilqg {

void PlanSearch::fields(FieldVisitor& v) {
  constexpr const char* kLee = "Lee 2017";
  v.number("plan_s", plan_s, "time that is planned [s], what follows is held; 0: the whole episode", at_least(0));
  v.choice("cost", cost, "minus the reward, minus its logarithm, or first the latter",
           {"linear", "logarithmic", "both"}, published("linear", kLee));
  v.number("first_costs", first_costs, "fraction of the task's costs of steps that the first iterations know",
           between(0, 1), published(1, kLee));
  v.number("action_cost", action_cost, "cost of an action at its bound, for a step, beside the reward", above(0));
  v.number("uncertainty", uncertainty, "weight of what the model's variance costs; 0: plans know the mean alone",
           at_least(0));
  v.boolean("hold", hold, "plans end with feedback of an infinite horizon near a goal, where that is better",
            published(false, kLee));
  v.integer("starts", starts, "random actions that plans begin with, beside the last plan", between(1, 10000));
  v.number("start_size", start_size, "fraction of their range, about its middle, that such actions are in",
           between(0, 1));
  v.number("start_hold_s", start_hold_s, expert("how long such an action is held [s]; 0: a step"), at_least(0));
  v.integer("first_iterations", first_iterations, expert("iterations for every start"), between(1, 100000));
  v.integer("finalists", finalists, expert("plans that are improved further"), between(1, 10000));
  v.integer("iterations", iterations, "iterations at most for these", between(0, 100000));
  v.integer("selection", selection, "simulated episodes that plans are compared in", between(1, 100000));
  v.number("tolerance", tolerance,
           "fraction of the highest return that a plan which solves the task more often may lack", at_least(0),
           published(0, kLee));
}

Options::Options() { model.gp.fit.starts = 3, model.gp.fit.part_rows = 200; }  // as of GPs around a fixed prior

void Options::fields(FieldVisitor& v) {
  v.boolean("identify", identify, "the prior's parameters are learned with the GPs, as GP-MI does");
  v.group("model", model);
  v.group("search", search);
  v.boolean("success_test", success_test, "plans may be chosen by the task's test of success, not by return alone",
            published(false));
}

}  // namespace rehearse::learners::gp_ilqg
