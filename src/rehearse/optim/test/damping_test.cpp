#include "rehearse/optim/damping.hpp"

#include <gtest/gtest.h>

namespace rehearse::optim {
namespace {

TEST(Damping, GrowsWithRefusalsAndFallsToTheLeast) {
  Damping damping(1e-7);
  const double first = damping.value();
  damping.refuse();
  EXPECT_DOUBLE_EQ(damping.value(), 10 * first);
  for (int i = 0; i < 9; ++i) damping.judge(0.9, 1);
  EXPECT_DOUBLE_EQ(damping.value(), 1e-7);
  damping.refuse();
  EXPECT_DOUBLE_EQ(damping.value(), first) << "from less than the first to the first at once";
}

TEST(Damping, GrowsWhereTheModelPromisedTooMuch) {
  Damping damping(1e-9);
  const double first = damping.value();
  damping.judge(0.5, 1);
  EXPECT_DOUBLE_EQ(damping.value(), first);
  damping.judge(0.1, 1);
  EXPECT_DOUBLE_EQ(damping.value(), 4 * first);
}

}  // namespace
}  // namespace rehearse::optim
