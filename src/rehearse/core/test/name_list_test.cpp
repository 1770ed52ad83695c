#include "rehearse/core/name_list.hpp"

#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(NameList, NamesAFewAndCountsTheOthers) {
  EXPECT_EQ(list_of({}, 2), "");
  EXPECT_EQ(list_of({"m"}, 2), "m");
  EXPECT_EQ(list_of({"m", "l"}, 2), "m, l");
  EXPECT_EQ(list_of({"m", "l", "b", "c"}, 2), "m, l and 2 more");
}

}  // namespace
}  // namespace rehearse
