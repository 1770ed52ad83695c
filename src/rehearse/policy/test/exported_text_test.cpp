#include "rehearse/policy/exported_text.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "exported_fixture.hpp"

namespace rehearse::policy {
namespace {

TEST(ExportedText, NumbersReadBack) {
  for (const double value : {0.0, 1.0, -3.0, 0.1, 1e300, 1.0 / 3, 1e-300, -2.5e17}) {
    EXPECT_EQ(std::stod(number(value)), value);
    EXPECT_NE(number(value).find_first_of(".e"), std::string::npos) << number(value);
  }
}

TEST(ExportedText, RowsAreInBracketsAndShortLines) {
  EXPECT_EQ(rows(Matrix{{1, 2}, {3, 4.5}}, {'[', ']', "  "}), "[[1.0, 2.0],\n   [3.0, 4.5]]");
  std::istringstream text("    " + numbers(Vector::Constant(99, 1.0 / 3), {'{', '}', "    "}));
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 120u);
}

TEST(ExportedText, IsFilled) {
  EXPECT_EQ(filled("@A@ and @B@", {{"A", "@B@"}, {"B", "2"}}), "@B@ and 2");
  EXPECT_THROW(filled("@C@", {}), std::out_of_range);
}

TEST(ExportedText, ExplainsStatesAndActions) {
  std::string all;
  for (const std::string& line : explanation(exports::exported(exports::cases().front(), exports::asked(1, 0.1))))
    all += line + "\n";
  for (const char* part : {"slider", "gp-mi, prior near, seed 3", "2, return 4.5", "state 1    angle",
                           "action 0   a, from -3.5 to 3.5", "0.1 s"})
    EXPECT_NE(all.find(part), std::string::npos) << all;
}

}  // namespace
}  // namespace rehearse::policy
