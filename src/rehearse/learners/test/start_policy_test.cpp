#include "rehearse/learners/start_policy.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/test/slider.hpp"
#include "rehearse/policy/network.hpp"

namespace rehearse::learners {
namespace {

TEST(StartPolicy, IsWherePoliciesAreSearched) {
  Setting setting;
  setting.policy = policy::make_linear(
      {.features = FeatureMap({StateKind::plain}), .scale = Vector::Ones(1), .squash = {{{-1, 1}}, 1}});
  EXPECT_NO_THROW(require_start_in_box(setting, 5, "search.box"));
  setting.start = Vector{{-7.5, 0}};
  const auto why = [&](double box) -> std::string {
    try {
      require_start_in_box(setting, box, "archive.box");
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why(5),
            "archive.box: parameter 1 of the policy to begin with is -7.5, policies are searched in -5 to 5: set "
            "archive.box to 7.5 or more");
  EXPECT_EQ(why(7.5), "");
  setting.start = Vector{{kNaN, 0}};
  EXPECT_NE(why(7.5), "");
}

}  // namespace
}  // namespace rehearse::learners
