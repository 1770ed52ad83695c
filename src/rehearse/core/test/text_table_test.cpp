#include "rehearse/core/text_table.hpp"

#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(TextTable, ColumnsStandBelowOneAnother) {
  EXPECT_EQ(aligned({{"state", "off by", "note"}, {"θ", "1"}, {"angle [°]", "0.25", ""}}),
            (std::vector<std::string>{"state      off by  note", "θ          1", "angle [°]  0.25"}));
  EXPECT_EQ(aligned({}), std::vector<std::string>{});
  EXPECT_EQ(aligned({{}, {"a"}}), (std::vector<std::string>{"", "a"}));
}

TEST(TextTable, CharactersAreNotBytes) { EXPECT_EQ(characters("≥ 1 °"), 5U); }

TEST(TextTable, TheFirstCharactersAreWhole) {
  EXPECT_EQ(first_characters("a≥°", 0), "");
  EXPECT_EQ(first_characters("a≥°", 2), "a≥");
  EXPECT_EQ(first_characters("a≥°", 3), "a≥°");
  EXPECT_EQ(first_characters("a≥°", 4), "a≥°");
}

}  // namespace
}  // namespace rehearse
