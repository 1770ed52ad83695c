#include "rehearse/learners/pilco/options.hpp"

namespace rehearse::learners::pilco {

void Options::fields(FieldVisitor& v) {
  v.group("model", model);
  v.group("search", search);
  v.boolean("success_test", success_test, "searches begin anew until a trial passes the test of success; false: always",
            published(false));
  if (!pi_rem)
    v.number("first_trial.hold_s", first_trial_hold_s, "how long a random action is held [s]; 0: a step", at_least(0));
  if (prior) prior->fields(v);
  if (pi_rem) pi_rem->fields(v);
}

void PiRemOptions::fields(FieldVisitor& v) {
  constexpr const char* kSaveriano = "Saveriano 2017";
  v.choice("model.through", through,
           "how a Gaussian goes through the prior: by its slopes at the mean, or by points about it",
           {"linearised", "unscented"}, published("linearised", kSaveriano));
  v.boolean("model.identify", identify, "GP-MI finds the prior's parameters before each trial",
            published(false, kSaveriano));
  v.integer("search.prior_searches", searches, "searches on the prior alone, each from a first policy of its own",
            between(1, 1000), published(1, kSaveriano));
  v.number("search.prior_start_std", start_std,
           "deviation of the start that policies for the prior alone are made for, at least [each state's unit]",
           between(0, 1e6), published(0, kSaveriano));
}

void PriorPhaseOptions::fields(FieldVisitor& v) {
  v.integer("pilco.prior_episodes", episodes, "episodes at most that are learned from on the prior", at_least(1));
  v.integer("pilco.prior_settled", settled,
            "episodes in a row that teach nothing and end the phase on the prior; 0: none do", at_least(0),
            published(0));
  v.integer("pilco.prior_inducing", inducing, "points at most that sum up what was learned on the prior",
            between(1, 1e5));
}

}  // namespace rehearse::learners::pilco
