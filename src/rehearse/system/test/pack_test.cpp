#include <cmath>

#include <gtest/gtest.h>

#define REHEARSE_EQUATION "rehearse/system/test/functions.hpp"
#include "rehearse/system/equation_kernel.hpp"

namespace rehearse::system {
namespace {

const Vector kOffset{{0.25}}, kStart = Vector::Zero(10);

Vector expected(double u) {
  const double a = u + kOffset(0);
  return Vector{{std::sin(a), std::cos(a), std::exp(a), std::tanh(a), std::sqrt(a), std::abs(a), 2 * a + 3, 3 - 2 * a,
                 1 / a - a * 0.5, ((a + 3) * a - 1) / 2}};
}

void expect_near(const Vector& ours, const Vector& theirs, const char* what) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (Index i = 0; i < ours.size(); ++i)
    EXPECT_TRUE(std::isnan(theirs(i))
                    ? std::isnan(ours(i))
                    : ours(i) == theirs(i) || std::abs(ours(i) - theirs(i)) <= 1e-14 * (1 + std::abs(theirs(i))))
        << what << " of function " << i << ": " << ours(i) << ", expected " << theirs(i);
}

TEST(Pack, HasTheFunctionsOfANumber) {
  const Vector U{{-3, -1, -0.4, 0, 0.3, 1, 2, 8, 50, 2000, -700, kNaN}};
  Matrix dX(U.size(), 10);
  equation_kernel().change(Matrix::Zero(U.size(), 10), U, kOffset.data(), 1, 1, dX);
  for (Index i = 0; i < U.size(); ++i) {
    Vector slope(10);
    equation_kernel().derivative(kStart.data(), &U(i), kOffset.data(), slope.data());
    expect_near(slope, expected(U(i)), "slope");
    if (U(i) > 0 && U(i) < 700)  // else a root is NaN, or the exponential infinite, and so is the row
      expect_near(dX.row(i).transpose(), expected(U(i)), "change");
  }
}

}  // namespace
}  // namespace rehearse::system
