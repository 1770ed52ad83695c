#include "rehearse/policy/exported_near.hpp"

#include <gtest/gtest.h>

#include "exported_fixture.hpp"

namespace rehearse::policy {
namespace {

/// Tests of the whole texts compare their actions with the policy's.
TEST(ExportedNear, IsThereForPoliciesThatHandOver) {
  for (const exports::Case& each : exports::cases()) {
    const Exported exported = exports::exported(each, exports::asked(1, 0.1));
    const bool hands_over = each.policy->name() == kHandOver;
    EXPECT_EQ(near_in_c(exported, "arm").find("arm_limit(u, lowest[o], highest[o])") != std::string::npos, hands_over);
    EXPECT_EQ(near_in_numpy(exported).find("u = np.where(") != std::string::npos, hands_over);
  }
}

}  // namespace
}  // namespace rehearse::policy
