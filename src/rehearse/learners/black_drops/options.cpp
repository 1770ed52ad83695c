#include "rehearse/learners/black_drops/options.hpp"

#include <variant>

namespace rehearse::learners::black_drops {

void FirstTrial::fields(FieldVisitor& v) {
  v.choice("kind", kind, "first trial without a prior: random actions, their bounds, or a random policy",
           {"actions", "extremes", "policy"}, published("policy"));
  v.number("hold_s", hold_s, "how long a random action is held [s]; 0: a step", at_least(0), published(0, kAuthors));
  v.number("cautious", cautious,
           "of tasks with limits: random actions are in this fraction of their range, about its middle", between(0, 1));
}

void Retry::fields(FieldVisitor& v) {
  v.integer("searches", searches, "more searches at most, while no policy is expected to solve the task",
            between(0, 1000), published(0));
  v.number("tolerance", tolerance, "fraction of the highest return that a policy which solves the task may lack",
           at_least(0));
  v.number("uncertain_tolerance", uncertain_tolerance,
           "such a fraction where the model is uncertain; 0: solving is not preferred", at_least(0), published(0));
}

void Options::fields(FieldVisitor& v) {
  std::visit([&](auto& kind) { v.group("model", kind); }, model);
  v.group("reward", reward);
  v.group("search", search);
  v.group("first_trial", first_trial);
  v.boolean("start_from_best", start_from_best, "a descent starts from the best policy observed");
  v.boolean("start_from_examples", start_from_examples, "a descent starts from each example that the policy brings",
            published(false));
  v.group("retry", retry);
  v.boolean("success_test", success_test, "policies may be chosen by the task's test of success, not by return alone",
            published(false));
  v.integer("prior_searches", prior_searches, "searches on the prior before the first trial", between(1, 1000));
  v.number("prior_variance", prior_variance, "variance of predictions before there are data", at_least(0));
}

}  // namespace rehearse::learners::black_drops
