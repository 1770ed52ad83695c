#include "rehearse/gp/inputs.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::gp {
namespace {

TEST(Inputs, SpreadIsTheSampleDeviation) {
  Matrix X(4, 1);
  X << 1, 2, 3, 4;
  const Inputs inputs(X);
  EXPECT_DOUBLE_EQ(inputs.spread()(0), std::sqrt(5.0 / 3));
  EXPECT_DOUBLE_EQ(inputs.unit()(0, 0), -1);
  EXPECT_DOUBLE_EQ(inputs.unit()(3, 0), 1);
}

TEST(Inputs, ConstantColumnsHaveAFiniteSpread) {
  Matrix X(3, 3);
  X << 0, -7, 0.1, 0, -7, 0.1 + 1e-17, 0, -7, 0.1;
  const Inputs inputs(X);
  EXPECT_EQ(inputs.spread(), Vector(Eigen::Vector3d(1, 7, 1)));
  EXPECT_TRUE(inputs.unit().isZero(1e-15));
}

TEST(Inputs, HugeValuesStayFinite) {
  Matrix X(3, 1);
  X << -1.7e308, 0, 1.7e308;
  const Inputs inputs(X);
  EXPECT_TRUE(inputs.unit().allFinite());
  EXPECT_TRUE(inputs.spread().allFinite());
}

TEST(Inputs, OneRowIsEnoughAndNoRowIsNot) {
  EXPECT_EQ(Inputs(Matrix::Constant(1, 2, 3)).spread(), Vector(Vector::Constant(2, 3)));
  EXPECT_THROW(Inputs(Matrix(0, 2)), InvalidInput);
}

TEST(Inputs, NamesWhatIsNotFinite) {
  Matrix X = Matrix::Zero(2, 2);
  X(1, 0) = kNaN;
  try {
    Inputs{X};
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "gp inputs(1, 0) = nan, must be finite");
  }
}

}  // namespace
}  // namespace rehearse::gp
