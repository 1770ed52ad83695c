#include "rehearse/campaign/draws.hpp"

#include <set>

#include <gtest/gtest.h>

#include "rehearse/core/options.hpp"

namespace rehearse::campaign {
namespace {

double value(const experiment::FileOption& option) {
  double number = 0;
  EXPECT_TRUE(from_text(option.text, number)) << option.text;
  return number;
}

// 200 draws: their mean is beyond five deviations with probability 6e-7.
TEST(Draws, AreUniformAndDependOnSeedAndNameAlone) {
  const Draw mass{.key = "plant.m", .low = 1, .high = 3, .line = 7}, length{.key = "plant.l", .low = 1, .high = 3};
  std::set<double> values;
  double sum = 0;
  for (Index seed = 1; seed <= 200; ++seed) {
    const experiment::FileOption option = drawn(mass, seed);
    EXPECT_EQ(option.key, "plant.m");
    EXPECT_EQ(option.line, 7);
    EXPECT_EQ(option.text, drawn(mass, seed).text);
    EXPECT_NE(option.text, drawn(length, seed).text);
    values.insert(value(option));
    sum += value(option);
  }
  EXPECT_EQ(values.size(), 200u);
  EXPECT_GE(*values.begin(), 1);
  EXPECT_LE(*values.rbegin(), 3);
  EXPECT_NEAR(sum / 200, 2, 5 * 2 / std::sqrt(12.0 * 200));
}

}  // namespace
}  // namespace rehearse::campaign
