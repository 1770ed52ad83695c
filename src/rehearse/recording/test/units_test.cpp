#include "rehearse/recording/units.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace rehearse::recording {
namespace {

TEST(Units, AreConvertedWhereThatIsSafe) {
  EXPECT_EQ(conversion("rad", "rad"), 1);
  EXPECT_EQ(conversion("furlong", "furlong"), 1);
  EXPECT_DOUBLE_EQ(*conversion("deg", "rad"), std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(*conversion("rpm", "rad/s"), std::numbers::pi / 30);
  EXPECT_DOUBLE_EQ(*conversion("rad", "deg"), 180 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(*conversion("ms", "s"), 1e-3);
  EXPECT_DOUBLE_EQ(*conversion("ns", "s"), 1e-9);
  EXPECT_DOUBLE_EQ(*conversion("mm", "m"), 1e-3);
  EXPECT_EQ(conversion("N·m", "N m"), 1);
  EXPECT_DOUBLE_EQ(*conversion("mN m", "Nm"), 1e-3);
}

TEST(Units, OthersAreNot) {
  EXPECT_FALSE(conversion("deg", "m"));
  EXPECT_FALSE(conversion("rad", "rad/s"));
  EXPECT_FALSE(conversion("furlong", "m"));
  EXPECT_FALSE(conversion("RAD", "rad"));
}

TEST(Units, AreKnownByWhatIsConvertedToThem) {
  EXPECT_EQ(units_like("m/s"), (std::vector<std::string>{"m/s", "cm/s", "mm/s"}));
  EXPECT_EQ(units_like("furlong"), std::vector<std::string>{"furlong"});
}

}  // namespace
}  // namespace rehearse::recording
