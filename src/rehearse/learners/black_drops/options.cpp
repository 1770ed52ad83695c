#include "rehearse/learners/black_drops/options.hpp"

#include <variant>

namespace rehearse::learners::black_drops {

void FirstTrial::fields(FieldVisitor& v) {
  v.choice("kind", kind, "first trial without a prior: random actions, their bounds, or a random policy",
           {"actions", "extremes", "policy"}, published("policy"));
  v.number("hold_s", hold_s, "time that a random action is held, a fifth of an episode at most [s]; 0: one step",
           at_least(0), published(0, kAuthors));
  v.number("cautious", cautious,
           "tasks with limits: range of random actions, as a fraction of the full range around its centre",
           between(0, 1));
}

void Retry::fields(FieldVisitor& v) {
  v.integer("searches", searches,
            "further searches at most, until a policy is expected to solve the task or a return is found again",
            between(0, 1000), published(0));
  v.number("tolerance", tolerance, "return that a policy which solves the task may lose, as a fraction of the highest",
           at_least(0));
  v.number("uncertain_tolerance", uncertain_tolerance,
           "the same where the model is uncertain, and for a new policy where the best was tried; 0: no loss",
           at_least(0), published(0));
}

void Options::fields(FieldVisitor& v) {
  std::visit([&](auto& kind) { v.group("model", kind); }, model);
  v.group("reward", reward);
  v.group("search", search);
  v.group("first_trial", first_trial);
  v.boolean("start_from_best", start_from_best, "one search run starts from the best policy observed");
  v.boolean("start_from_examples", start_from_examples,
            "one search run starts from each example of the policy class (such as the tripod gait)", published(false));
  v.group("retry", retry);
  v.boolean("success_test", success_test,
            "policies are chosen by the task's success criterion, too, not by return alone", published(false));
  v.integer("prior_searches", prior_searches, "searches on the prior before the first trial", between(1, 1000));
  v.number("prior_variance", prior_variance, "variance of predictions before there are data", at_least(0));
}

}  // namespace rehearse::learners::black_drops
