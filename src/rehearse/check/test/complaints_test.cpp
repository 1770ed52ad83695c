#include "rehearse/check/complaints.hpp"

#include <gtest/gtest.h>

namespace rehearse::check {
namespace {

TEST(Complaints, AreALineForEachThingThatIsWrong) {
  EXPECT_EQ(complaints({}), std::vector<std::string>{});
  EXPECT_EQ(complaints({.priors = {{.name = "light", .notes = {"a note is no complaint"}}}}),
            std::vector<std::string>{});
  const Tried tried{
      .steps = 7,
      .end = "the plant failed in step 8 of episode 1: it is hot",
      .priors = {{.name = "light", .states = 14, .failed = 3, .idle = {"mass"}, .broken = "does not repeat"},
                 {.name = "heavy", .failed = 7, .idle = {"mass"}}},
      .broken = {"an episode ends where it starts"},
      .notes = {"falling pays"}};
  const std::vector<std::string> lines = complaints(tried);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "an episode ends where it starts");
  EXPECT_EQ(lines[1], *tried.end);
  EXPECT_EQ(lines[2].find("prior light: mass changes no prediction on the 14 states tried"), 0u) << lines[2];
  EXPECT_EQ(lines[3], "prior light: does not repeat");
  EXPECT_EQ(lines[4], "prior heavy: none of 7 rows has a prediction; is dt_s in seconds?");
}

TEST(Complaints, AreNotWhatALearnerTakes) {
  EXPECT_FALSE(has_notes({.broken = {"it is broken"}, .notes = {}}));
  EXPECT_TRUE(has_notes({.notes = {"falling pays"}}));
  EXPECT_TRUE(has_notes({.priors = {{.name = "light", .notes = {"it is slow"}}}}));
  const Tried tried{.steps = 7, .priors = {{.name = "light", .failed = 3}}};
  EXPECT_TRUE(has_notes(tried));
  EXPECT_EQ(complaints(tried), std::vector<std::string>{});
}

}  // namespace
}  // namespace rehearse::check
