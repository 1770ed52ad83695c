#include "rehearse/learners/gp_ilqg/options.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

TEST(GpIlqgOptions, HaveDefaultsThatTheyAccept) {
  Options options;
  const Fields fields = [&](FieldVisitor& v) { options.fields(v); };
  EXPECT_EQ(field_violations(fields), std::vector<std::string>{});
  EXPECT_TRUE(set_field(fields, "search.cost", "logarithmic"));
  EXPECT_EQ(options.search.cost, PlanSearch::Cost::logarithmic);
  options.search.action_cost = 0;
  EXPECT_EQ(field_violations(fields).size(), 1U) << "without it a plan has no best action";
}

}  // namespace
}  // namespace rehearse::learners::gp_ilqg
