#include "rehearse/learners/pilco/options.hpp"

namespace rehearse::learners::pilco {

void Options::fields(FieldVisitor& v) {
  v.group("model", model);
  v.group("search", search);
  v.boolean("success_test", success_test,
            "searches restart until a trial meets the success criterion; false: before every trial", published(false));
  if (!pi_rem)
    v.number("first_trial.hold_s", first_trial_hold_s,
             "time that a random action is held, a fifth of an episode at most [s]; 0: one step", at_least(0));
  if (prior) prior->fields(v);
  if (pi_rem) pi_rem->fields(v);
}

void PiRemOptions::fields(FieldVisitor& v) {
  constexpr const char* kSaveriano = "Saveriano 2017";
  v.choice("model.through", through, "propagation of Gaussians through the prior: linearisation or unscented transform",
           {"linearised", "unscented"}, published("linearised", kSaveriano));
  v.boolean("model.identify", identify, "GP-MI finds the prior's parameters before each trial",
            published(false, kSaveriano));
  v.integer("search.prior_searches", searches,
            "searches on the prior alone, each from a random initial policy of its own", between(1, 1000),
            published(1, kSaveriano));
  v.number("search.prior_start_std", start_std,
           "smallest standard deviation of the start state in searches on the prior [each state's unit]",
           between(0, 1e6), published(0, kSaveriano));
}

void PriorPhaseOptions::fields(FieldVisitor& v) {
  v.integer("pilco.prior_episodes", episodes, "largest number of episodes of learning on the prior", at_least(1));
  v.integer("pilco.prior_settled", settled,
            "consecutive episodes without improvement that end learning on the prior; 0: never", at_least(0),
            published(0));
  v.integer("pilco.prior_inducing", inducing, "largest number of inducing points for the GPs learned on the prior",
            between(1, 1e5));
}

}  // namespace rehearse::learners::pilco
