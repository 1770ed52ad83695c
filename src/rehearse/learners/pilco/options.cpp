#include "rehearse/learners/pilco/options.hpp"

namespace rehearse::learners::pilco {

void Options::fields(FieldVisitor& v) {
  v.group("model", model);
  v.group("search", search);
  v.boolean("success_test", success_test, published(false));
  v.number("first_trial.hold_s", first_trial_hold_s, at_least(0));
  if (prior) prior->fields(v);
}

void PriorPhaseOptions::fields(FieldVisitor& v) {
  v.integer("pilco.prior_episodes", episodes, at_least(1));
  v.integer("pilco.prior_settled", settled, at_least(0), published(0));
  v.integer("pilco.prior_inducing", inducing, between(1, 1e5));
}

}  // namespace rehearse::learners::pilco
