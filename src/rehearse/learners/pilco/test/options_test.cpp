#include "rehearse/learners/pilco/options.hpp"

#include <gtest/gtest.h>

namespace rehearse::learners::pilco {
namespace {

bool has(Options options, const std::string& name) {
  for (const Field& field : describe_fields([&](FieldVisitor& v) { options.fields(v); }))
    if (field.name == name) return true;
  return false;
}

TEST(PilcoOptions, OfThePriorAreThereWhereThereIsOne) {
  for (const char* name : {"pilco.prior_episodes", "pilco.prior_settled", "pilco.prior_inducing"}) {
    EXPECT_FALSE(has({}, name));
    EXPECT_TRUE(has({.prior = PriorPhaseOptions{}}, name));
  }
  for (const char* name : {"model.through", "model.identify", "search.prior_searches"}) {
    EXPECT_FALSE(has({.prior = PriorPhaseOptions{}}, name));
    EXPECT_TRUE(has({.pi_rem = PiRemOptions{}}, name));
  }
  EXPECT_FALSE(has({.pi_rem = PiRemOptions{}}, "first_trial.hold_s")) << "there are no random actions";
  for (const char* name : {"model.inducing", "search.restarts", "success_test", "first_trial.hold_s"})
    EXPECT_TRUE(has({}, name)) << name;
}

TEST(PilcoOptions, AreValidByDefaultAndHaveBounds) {
  Options options{.prior = PriorPhaseOptions{}};
  const Fields fields = [&](FieldVisitor& v) { options.fields(v); };
  EXPECT_EQ(field_violations(fields), std::vector<std::string>{});
  options.first_trial_hold_s = -1;
  options.prior->episodes = 0;
  EXPECT_EQ(field_violations(fields), (std::vector<std::string>{"first_trial.hold_s = -1, must be ≥ 0",
                                                                "pilco.prior_episodes = 0, must be ≥ 1"}));
}

}  // namespace
}  // namespace rehearse::learners::pilco
