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

}  // namespace
}  // namespace rehearse
