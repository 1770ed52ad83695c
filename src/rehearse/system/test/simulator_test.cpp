#include "rehearse/system/simulator.hpp"

#include <cmath>
#include <functional>
#include <new>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::system {
namespace {

/// dX = X + U, unless the row's first state is negative: then `harm` is done. Keeps the sizes of the calls.
class Fragile final : public Simulator {
 public:
  using Harm = std::function<void(MatrixView row)>;
  explicit Fragile(Harm harm) : harm_(std::move(harm)) {}
  const ParameterSpace& parameters() const override { return space_; }
  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) const override {
    calls.push_back(X.rows());
    dX = X.colwise() + U.col(0);
    for (Index i = 0; i < X.rows(); ++i)
      if (X(i, 0) < 0) harm_(dX.middleRows(i, 1));
  }
  mutable std::vector<Index> calls;

 private:
  Harm harm_;
  ParameterSpace space_;
};

const Matrix kX{{1, 2}, {-1, 3}, {4, 5}, {-6, 7}, {8, 9}}, kU{{1}, {1}, {1}, {1}, {1}};

void expect_contained(const Fragile& simulator) {
  Matrix dX = Matrix::Zero(5, 2);
  EXPECT_EQ(change_contained(simulator, kX, kU, {}, dX), 2);
  for (Index i = 0; i < 5; ++i) {
    if (kX(i, 0) < 0) {
      EXPECT_TRUE(dX.row(i).array().isNaN().all()) << "the whole row, not only what failed";
    } else {
      EXPECT_EQ(dX.row(i), (kX.row(i).array() + 1).matrix());
    }
  }
}

TEST(ChangeContained, RowsThatAreNotFiniteOrHugeAreBlanked) {
  for (const double bad : {kNaN, kInf, -kInf, 1e300, -1e300, 1e12}) {
    const Fragile simulator([bad](MatrixView row) { row(0, 1) = bad; });
    expect_contained(simulator);
    EXPECT_EQ(simulator.calls.size(), 1u) << "no retry is needed";
  }
}

TEST(ChangeContained, WrongSizesAreTheCallersFault) {
  const auto simulator = make_simulator(ParameterSpace({Parameter::fixed("m", 1)}), [](auto...) { FAIL(); });
  const Vector phi{{1}};
  Matrix dX(5, 2), short_dX(4, 2), narrow_dX(5, 1);
  EXPECT_THROW(change_contained(*simulator, kX, kU, {}, dX), InvalidInput);
  EXPECT_THROW(change_contained(*simulator, kX, kU, phi, short_dX), InvalidInput);
  EXPECT_THROW(change_contained(*simulator, kX, kU, phi, narrow_dX), InvalidInput);
  EXPECT_THROW(change_contained(*simulator, kX, kU.topRows(4), phi, dX), InvalidInput);
  EXPECT_THROW(simulator->change(kX, kU, {}, dX), InvalidInput);
}

TEST(ChangeContained, ABatchThatThrowsIsRetriedRowByRow) {
  const Fragile standard([](MatrixView) { throw std::runtime_error("diverged"); });
  expect_contained(standard);
  EXPECT_EQ(standard.calls, (std::vector<Index>{5, 1, 1, 1, 1, 1}));
  expect_contained(Fragile([](MatrixView) { throw 7; }));
}

TEST(ChangeContained, ALackOfMemoryIsNoRowsFault) {
  const Fragile at_once([](MatrixView) { throw std::bad_alloc(); });
  Matrix dX(5, 2);
  EXPECT_THROW(change_contained(at_once, kX, kU, {}, dX), std::bad_alloc);
  int calls = 0;
  const Fragile in_a_row([&](MatrixView) {
    if (++calls == 1) throw std::runtime_error("diverged");
    throw std::bad_alloc();
  });
  EXPECT_THROW(change_contained(in_a_row, kX, kU, {}, dX), std::bad_alloc);
}

TEST(ChangeContained, GoodRowsAreLeftAlone) {
  const Fragile simulator([](MatrixView) { FAIL(); });
  const Matrix X = kX.cwiseAbs();
  Matrix dX(5, 2);
  EXPECT_EQ(change_contained(simulator, X, kU, {}, dX), 0);
  EXPECT_EQ(dX, (X.array() + 1).matrix());
  Matrix none(0, 2);
  EXPECT_EQ(change_contained(simulator, X.topRows(0), kU.topRows(0), {}, none), 0);
}

TEST(ChangeContained, WorksOnBlocks) {
  const Fragile simulator([](MatrixView) { throw 7; });
  Matrix around = Matrix::Constant(7, 4, 0.5);
  change_contained(simulator, kX, kU, {}, around.block(1, 1, 5, 2));
  EXPECT_EQ(around(1, 1), 2);
  around.block(1, 1, 5, 2).setConstant(0.5);
  EXPECT_EQ(around, Matrix::Constant(7, 4, 0.5));
}

}  // namespace
}  // namespace rehearse::system
