#include "rehearse/campaign/share.hpp"

#include <gtest/gtest.h>

namespace rehearse::campaign {
namespace {

TEST(Share, IsKOfN) {
  const auto share = read_share("3/20");
  ASSERT_TRUE(share);
  EXPECT_EQ(share->number, 3);
  EXPECT_EQ(share->of, 20);
  EXPECT_TRUE(read_share("1/1"));
  for (const char* wrong : {"", "3", "/", "3/", "/20", "0/2", "3/2", "-1/2", "1/2/3", "1 /2", "1.0/2", "a/b"})
    EXPECT_FALSE(read_share(wrong)) << wrong;
}

}  // namespace
}  // namespace rehearse::campaign
