#include "rehearse/robot_file/complaints.hpp"

#include <gtest/gtest.h>

namespace rehearse::robot_file {
namespace {

TEST(Complaints, AreALineForEachThingThatIsWrong) {
  EXPECT_EQ(complaints({}), std::vector<std::string>{});
  EXPECT_EQ(complaints({.priors = {{.name = "light", .notes = {"a note is no complaint"}}}}),
            std::vector<std::string>{});
  const Tried tried{
      .steps = 7,
      .end = "",
      .priors = {{.name = "light", .states = 14, .failed = 3, .idle = {"mass"}, .broken = "does not repeat"}},
      .broken = {"falling pays"}};
  const std::vector<std::string> lines = complaints(tried);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "falling pays");
  EXPECT_EQ(lines[1], "the plant failed after 7 steps: it does not say why");
  EXPECT_EQ(lines[2].find("prior light: mass changes no prediction on the 14 states tried"), 0u) << lines[2];
  EXPECT_EQ(lines[3], "prior light: does not repeat");
  EXPECT_EQ(lines[4], "prior light: 3 of 7 rows have no prediction");
}

}  // namespace
}  // namespace rehearse::robot_file
