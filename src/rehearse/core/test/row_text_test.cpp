#include "rehearse/core/row_text.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/variables.hpp"

namespace rehearse {
namespace {

TEST(RowText, NamesEachValueUpToSoMany) {
  const std::vector<StateVariable> states = {{"v", "m/s"}, {"x", "m"}, {"a", "rad"}};
  EXPECT_EQ(row_text(states, Vector{{1, 2.5, -0.12345}}, 3), "v = 1, x = 2.5, a = -0.1235");
  EXPECT_EQ(row_text(states, Vector{{1, 2.5, 0}}, 2), "v = 1, x = 2.5, …");
  EXPECT_EQ(row_text(states, Vector{{1, 2.5}}, 2), "v = 1, x = 2.5") << "a robot behind its actuators has fewer";
}

}  // namespace
}  // namespace rehearse
