#include "rehearse/learners/gp_ilqg/options.hpp"

namespace rehearse::learners::gp_ilqg {

void PlanSearch::fields(FieldVisitor& v) {
  constexpr const char* kLee = "Lee 2017";
  v.number("plan_s", plan_s, "time that is planned [s], what follows is held; 0: the whole episode", at_least(0));
  v.choice("cost", cost, "cost that plans minimise: −reward, −log reward, or the latter first",
           {"linear", "logarithmic", "both"}, published("linear", kLee));
  v.number("first_costs", first_costs, "weight of the task's step costs in the first iterations", between(0, 1),
           published(1, kLee));
  v.number("action_cost", action_cost, "cost per step of an action at its bound, added to the reward's cost", above(0));
  v.number("uncertainty", uncertainty, "weight of the model's variance in the cost; 0: plans use the mean alone",
           at_least(0));
  v.boolean("hold", hold, "plans end with an infinite-horizon LQR near the goal, where that is better",
            published(false, kLee));
  v.boolean("soften", soften, "plans with higher action costs compete where measurement noise shakes the actions",
            published(false, kLee));
  v.integer("starts", starts, "random initial plans, beside the last plan", between(1, 10000));
  v.number("start_size", start_size,
           "range of the random initial actions, as a fraction of the full range around its centre", between(0, 1));
  v.number("start_hold_s", start_hold_s,
           expert("time that a random initial action is held, a fifth of an episode at most [s]; 0: one step"),
           at_least(0));
  v.integer("first_iterations", first_iterations, expert("iterations for each start"), between(1, 100000));
  v.integer("finalists", finalists, expert("best plans that are improved further"), between(1, 10000));
  v.integer("iterations", iterations, "largest number of iterations for finalists", between(0, 100000));
  v.integer("selection", selection, "simulated episodes that plans are compared in", between(1, 100000));
  v.number("tolerance", tolerance,
           "return that a plan which solves the task more often may lose, as a fraction of the highest", at_least(0),
           published(0, kLee));
}

Options::Options() { model.gp.fit.starts = 3, model.gp.fit.part_rows = 200; }  // as of GPs around a fixed prior

void Options::fields(FieldVisitor& v) {
  v.boolean("identify", identify, "the prior's parameters are learned with the GPs, as GP-MI does");
  v.group("model", model);
  v.group("search", search);
  v.boolean("success_test", success_test, "plans are chosen by the task's success criterion, too, not by return alone",
            published(false));
}

}  // namespace rehearse::learners::gp_ilqg
