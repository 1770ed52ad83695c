#include "rehearse/core/errors.hpp"

#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(Violations, AreThrownTogetherALineEach) {
  Violations violations;
  violations.throw_if_any();
  violations.require(true, "holds");
  EXPECT_TRUE(violations.empty());
  violations.require(false, "a = 0, must be > 0");
  violations.add("b is missing");
  EXPECT_EQ(violations.list().size(), 2u);
  try {
    violations.throw_if_any();
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "a = 0, must be > 0\nb is missing");
  }
}

TEST(Violations, OfWorkThatThrowsAreAmongThem) {
  Violations violations;
  EXPECT_TRUE(violations.attempt([] {}));
  EXPECT_FALSE(violations.attempt([] {
    throw InvalidInput(std::vector<std::string>{"a is missing", "b is missing"});
  }));
  EXPECT_EQ(violations.list(), (std::vector<std::string>{"a is missing", "b is missing"}));
  EXPECT_THROW(violations.attempt([] { throw std::logic_error("a fault of ours"); }), std::logic_error);
}

}  // namespace
}  // namespace rehearse
