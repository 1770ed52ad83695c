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

TEST(TextTable, BytesThatAreNoCharacterAreFound) {
  EXPECT_EQ(character_at("a≥°", 0), 1U);
  EXPECT_EQ(character_at("a≥°", 1), 3U);
  EXPECT_EQ(character_at("a≥°", 2), 0U) << "within a character";
  EXPECT_EQ(character_at("\xe2\x89", 0), 0U) << "cut";
  EXPECT_EQ(character_at("\xff", 0), 0U);
}

TEST(TextTable, TheFirstCharactersAreWhole) {
  EXPECT_EQ(first_characters("a≥°", 0), "");
  EXPECT_EQ(first_characters("a≥°", 2), "a≥");
  EXPECT_EQ(first_characters("a≥°", 3), "a≥°");
  EXPECT_EQ(first_characters("a≥°", 4), "a≥°");
}

}  // namespace
}  // namespace rehearse
