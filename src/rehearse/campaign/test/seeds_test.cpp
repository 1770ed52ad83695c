#include "rehearse/campaign/seeds.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/test/fake.hpp"

namespace rehearse::campaign {
namespace {

std::vector<Index> seeds(const std::string& text) {
  const toml::table table = toml::parse("seeds = " + text);
  return seeds_of(*table.get("seeds"));
}

std::string about(const std::string& text) {
  return experiment::fake::message_of<InvalidInput>([&] { seeds(text); });
}

TEST(CampaignSeeds, AreNumbersRangesAndListsOfBoth) {
  using Seeds = std::vector<Index>;
  EXPECT_EQ(seeds("7"), Seeds{7});
  EXPECT_EQ(seeds("\"1-3\""), (Seeds{1, 2, 3}));
  EXPECT_EQ(seeds("[9, \"3-4\", \"1\"]"), (Seeds{9, 3, 4, 1}));
}

TEST(CampaignSeeds, SaysWhatIsWrong) {
  EXPECT_EQ(about("\"3-1\""), "seeds = \"3-1\", the first must not be above the last");
  EXPECT_EQ(about("\"1-10000000\""), "seeds = \"1-10000000\" are 10000000, must be ≤ 100000");
  EXPECT_EQ(about("[2, \"1-3\"]"), "seeds has 2 twice");
  EXPECT_EQ(about("[]"), "seeds has none");
  EXPECT_EQ(about("-1"), "seeds = -1, must be whole numbers from 0 to 2^53, or \"FIRST-LAST\"");
  EXPECT_EQ(about("\"1-x\""), "seeds = 1-x, must be whole numbers from 0 to 2^53, or \"FIRST-LAST\"");
  EXPECT_EQ(about("1.5"), "seeds must be whole numbers, \"FIRST-LAST\", or a list of these");
}

}  // namespace
}  // namespace rehearse::campaign
