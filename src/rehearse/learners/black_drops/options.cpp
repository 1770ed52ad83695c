#include "rehearse/learners/black_drops/options.hpp"

#include <variant>

namespace rehearse::learners::black_drops {

void FirstTrial::fields(FieldVisitor& v) {
  v.choice("kind", kind, {"actions", "extremes", "policy"}, published("policy"));
  v.number("hold_s", hold_s, at_least(0), published(0, kAuthors));
}

void MeanSearch::fields(FieldVisitor& v) {
  v.integer("policies", policies, at_least(0), published(0));
  v.number("tolerance", tolerance, at_least(0));
}

void Retry::fields(FieldVisitor& v) {
  v.integer("searches", searches, between(0, 1000), published(0));
  v.number("tolerance", tolerance, at_least(0));
  v.number("uncertain_tolerance", uncertain_tolerance, at_least(0), published(0));
}

void Exploration::fields(FieldVisitor& v) {
  v.number("gain", gain, at_least(0), published(0));
  v.number("required", required, at_least(0));
}

void Options::fields(FieldVisitor& v) {
  std::visit([&](auto& kind) { v.group("model", kind); }, model);
  v.group("reward", reward);
  v.group("search", search);
  v.group("first_trial", first_trial);
  v.boolean("start_from_best", start_from_best);
  v.boolean("start_from_examples", start_from_examples, published(false));
  v.group("explore", explore);
  v.group("mean_search", mean_search);
  v.group("retry", retry);
  v.boolean("success_test", success_test, published(false));
  v.integer("carried", carried, at_least(0), published(0));
  v.integer("prior_searches", prior_searches, between(1, 1000));
  v.number("prior_variance", prior_variance, at_least(0));
}

}  // namespace rehearse::learners::black_drops
