#include "rehearse/qd/variation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "square_archive.hpp"

namespace rehearse::qd {
namespace {

TEST(Variation, HasTheSpreadThatItIsGiven) {
  Archive two = square_archive();
  const Vector a = Vector::Zero(5), b = Vector{{0.8, 0, 0, 0, 0}};
  two.add(0, 0, a.data(), a.data());
  two.add(1, 0, a.data(), b.data());
  const Index n = 20000;
  Matrix X(n, 5);
  const std::vector<Interval> box(5, {-10, 10});
  Varier({.iso_sigma = 0.01, .line_sigma = 0.5}, box, 5, {.seed = 7}).vary(two, 0, X);
  // Along the other parameters σ = 0.01 · 20; along the first also, with probability ½, a line of 0.5 · 0.8, and ± 0.4
  // from the choice of the parent. Standard errors: 1 % of the variances.
  for (Index p = 1; p < 5; ++p) EXPECT_NEAR(X.col(p).squaredNorm() / n, 0.04, 5 * 0.0004);
  EXPECT_NEAR((X.col(0).array() - 0.4).square().mean(), 0.04 + 0.16 + 0.5 * 0.16, 5 * 0.003);
  EXPECT_NEAR(X.col(0).mean(), 0.4, 5 * 0.004);
  Matrix part(100, 5);
  Varier({.iso_sigma = 0.01, .line_sigma = 0.5}, box, 5, {.seed = 7}).vary(two, 700, part);
  EXPECT_EQ(part, X.middleRows(700, 100));
}

TEST(Variation, ResetsOnTheLattice) {
  Archive one = square_archive();
  const Vector zero = Vector::Zero(5);
  one.add(0, 0, zero.data(), zero.data());
  const Index n = 20000;
  Matrix X(n, 5);
  const Varier varier({.kind = Variation::Kind::reset, .reset_rate = 0.1, .lattice = 0.25},
                      std::vector<Interval>(5, {-1, 1}), 5, {.seed = 7});
  varier.vary(one, 0, X);
  // One in ten is drawn anew, of these one in five is 0 again: 0.08 ± 0.0009 (n · 5 draws).
  EXPECT_NEAR((X.array() != 0).cast<double>().mean(), 0.08, 5 * 0.0009);
  varier.draw(0, X);
  for (const double value : {-1.0, -0.5, 0.0, 0.5, 1.0})
    EXPECT_NEAR((X.array() == value).cast<double>().mean(), 0.2, 5 * 0.0013) << value;
}

TEST(Variation, AboutAStartSolutionsStayInTheBox) {
  const Varier varier({.iso_sigma = 0.1}, {{0, 1}, {-10, 10}}, 2, {.seed = 7});
  Matrix X(2000, 2), part(50, 2);
  varier.draw_about(Vector{{0.95, 0}}, 0, X);
  EXPECT_EQ(X.col(0).maxCoeff(), 1);
  EXPECT_GT(X.col(0).minCoeff(), 0.95 - 6 * 0.1);
  EXPECT_GT(X.col(1).cwiseAbs().maxCoeff(), 3) << "σ is 0.1 of each width";
  varier.draw_about(Vector{{0.95, 0}}, 300, part);
  EXPECT_EQ(part, X.middleRows(300, 50));
}

}  // namespace
}  // namespace rehearse::qd
