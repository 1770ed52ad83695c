#include "rehearse/recording/problems.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::recording {
namespace {

TEST(Problems, AreInTheOrderOfRowsAndOfAKindOneALine) {
  Problems problems("log.csv");
  EXPECT_NO_THROW(problems.throw_if_any());
  problems.add(7, "b", "late");
  problems.add(3, "a", "early");
  problems.add(4, "a", "not said");
  problems.add(0, "c", "of all");
  try {
    problems.throw_if_any();
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "log.csv: of all\nlog.csv: row 3: early (and so in 1 more row)\nlog.csv: row 7: late");
  }
}

}  // namespace
}  // namespace rehearse::recording
