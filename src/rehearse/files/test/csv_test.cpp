#include "rehearse/files/csv.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::files {
namespace {

TEST(Csv, QuotesWhatWouldBeTakenForSomethingElse) {
  Csv csv({"a", "b, c"});
  csv.row({"say \"no\"", "two\nlines"});
  csv.row({"", " plain "});
  EXPECT_EQ(csv.text(), "a,\"b, c\"\n\"say \"\"no\"\"\",\"two\nlines\"\n, plain \n");
}

TEST(Csv, NumbersKeepEveryDigitAndWhatIsNoneIsEmpty) {
  EXPECT_EQ(Csv::cell(Index{-9007199254740993}), "-9007199254740993");
  EXPECT_EQ(std::stod(Csv::cell(0.1 + 0.2)), 0.1 + 0.2);
  EXPECT_EQ(Csv::cell(0.5), "0.5");
  EXPECT_EQ(Csv::cell(std::nan("")), "");
  EXPECT_EQ(Csv::cell(std::optional<double>{}), "");
  EXPECT_EQ(Csv::cell(std::optional<Index>{3}), "3");
}

}  // namespace
}  // namespace rehearse::files
