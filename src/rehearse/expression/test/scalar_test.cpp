#include "rehearse/expression/scalar.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::expression {
namespace {

TEST(Scalar, OperationsAreThoseOfTheCLibrary) {
  EXPECT_EQ(evaluate(Op::subtract, 3, 5, 0), -2);
  EXPECT_EQ(evaluate(Op::arctangent2, 1, -1, 0), std::atan2(1, -1));
  EXPECT_EQ(evaluate(Op::sign, -3, 0, 0), -1);
  EXPECT_EQ(evaluate(Op::sign, 0, 0, 0), 0);
  EXPECT_EQ(evaluate(Op::maximum, 2, 3, 0), 3);
  EXPECT_EQ(evaluate(Op::where, 1, 2, 3), 2);
  EXPECT_EQ(evaluate(Op::where, 0, 2, 3), 3);
  EXPECT_EQ(evaluate(Op::logical_not, 0, 0, 0), 1);
}

TEST(Scalar, NaNIsNeverLost) {
  for (const Op op : {Op::minimum, Op::maximum, Op::less, Op::equal, Op::not_equal, Op::logical_and, Op::logical_or}) {
    EXPECT_TRUE(std::isnan(evaluate(op, kNaN, 1, 0)));
    EXPECT_TRUE(std::isnan(evaluate(op, 1, kNaN, 0)));
  }
  EXPECT_TRUE(std::isnan(evaluate(Op::where, kNaN, 1, 2)));
  EXPECT_TRUE(std::isnan(evaluate(Op::logical_not, kNaN, 0, 0)));
  EXPECT_TRUE(std::isnan(evaluate(Op::sign, kNaN, 0, 0)));
}

}  // namespace
}  // namespace rehearse::expression
