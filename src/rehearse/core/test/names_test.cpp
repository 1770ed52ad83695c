#include "rehearse/core/names.hpp"

#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(Names, WordsAreOfLettersDigitsAndDashes) {
  for (const char* word : {"gp-mi", "cart_2d", "7"}) EXPECT_TRUE(is_word(word)) << word;
  for (const char* none : {"", "a b", "a,b", "../p", "a.b", "ü"}) EXPECT_FALSE(is_word(none)) << none;
}

TEST(Names, InLowerCaseKeepWhatIsNoLetter) { EXPECT_EQ(in_lower_case("Time [S] Ä"), "time [s] Ä"); }

TEST(Names, OfFoldersLeaveNoFolder) {
  EXPECT_EQ(folder_name_of("cart-mi-a,b-7"), "cart-mi-a,b-7");
  EXPECT_EQ(folder_name_of("a/../b c:\n"), "a_.._b_c__");
}

}  // namespace
}  // namespace rehearse
