#include "rehearse/system/first_fault.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/system/simulator.hpp"

namespace rehearse::system {
namespace {

TEST(FirstFault, IsTheSmallestRowWhateverTheOrder) {
  const Matrix X{{2, 1}, {1, 7}, {1, 3}, {std::nan(""), 0}};
  for (const bool reversed : {false, true}) {
    FirstFault first;
    EXPECT_FALSE(first.get());
    for (Index i = 0; i < X.rows(); ++i) {
      const Index row = reversed ? X.rows() - 1 - i : i;
      first.add(X.row(row).transpose(), Vector{{0.5}}, std::to_string(row));
    }
    ASSERT_TRUE(first.get());
    EXPECT_EQ(first.get()->x, (Vector{{1, 3}}));
    EXPECT_EQ(first.get()->u, Vector{{0.5}});
    EXPECT_EQ(first.get()->why, "2");
    first.clear();
    EXPECT_FALSE(first.get());
  }
}

TEST(FirstFault, HasWhatASimulatorThrew) {
  const auto simulator = make_simulator({}, [](const auto& X, const auto&, const Vector&, MatrixView dX) {
    dX.setZero();
    if ((X.array() > 5).any()) throw std::runtime_error("too far");
    if (X.rows() == 1 && X(0, 0) < 0) dX.setConstant(std::nan(""));
  });
  FirstFault first;
  Matrix dX(3, 1);
  EXPECT_EQ(change_contained(*simulator, Matrix{{7}, {1}, {6}}, Matrix::Ones(3, 1), Vector(), dX, &first), 2);
  EXPECT_EQ(first.get()->x, Vector{{6}});
  EXPECT_EQ(first.get()->why, "too far");
  EXPECT_EQ(change_contained(*simulator, Matrix{{-1}}, Matrix::Ones(1, 1), Vector(), dX.topRows(1), &first), 1);
  EXPECT_EQ(first.get()->why, "") << "it gave no number";
}

}  // namespace
}  // namespace rehearse::system
