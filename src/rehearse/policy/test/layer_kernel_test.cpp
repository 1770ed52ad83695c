#include "rehearse/policy/layer_kernel.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.hpp"

namespace rehearse::policy {
namespace {

using fixture::normals;

TEST(Layer, IsItsFormulaForAnyNumberOfRowsAndStrides) {
  constexpr Index kInputs = 3, kOutputs = 2;
  for (Index rows = 1; rows <= 19; ++rows) {
    const Matrix W = normals(rows + 3, kOutputs * (kInputs + 1), 1), X = normals(rows + 5, kInputs, 2);
    for (const bool tanh : {false, true}) {
      Matrix out = Matrix::Constant(rows + 1, kOutputs, 7);
      layer(W.data(), W.rows(), X.data(), X.rows(), kInputs, out.data(), out.rows(), kOutputs, rows, tanh);
      for (Index r = 0; r < rows; ++r) {
        for (Index o = 0; o < kOutputs; ++o) {
          double a = W(r, o * (kInputs + 1) + kInputs);
          for (Index i = 0; i < kInputs; ++i) a += W(r, o * (kInputs + 1) + i) * X(r, i);
          EXPECT_NEAR(out(r, o), tanh ? std::tanh(a) : a, 1e-14 * (1 + std::abs(a)));
        }
      }
      EXPECT_EQ(out.row(rows), Matrix::Constant(1, kOutputs, 7)) << "nothing is written behind the last row";
    }
  }
}

TEST(Layer, ARowHasTheSameBitsAnywhere) {
  const Matrix W = normals(23, 4, 1), X = normals(23, 3, 2);
  Matrix all(23, 1), one(1, 1);
  layer(W.data(), 23, X.data(), 23, 3, all.data(), 23, 1, 23, true);
  for (Index r = 0; r < 23; ++r) {
    layer(W.data() + r, 23, X.data() + r, 23, 3, one.data(), 1, 1, 1, true);
    EXPECT_EQ(one(0, 0), all(r, 0));
  }
}

TEST(Layer, NanStaysInItsRow) {
  const Matrix W = normals(11, 4, 1);
  Matrix X = normals(11, 3, 2), clean(11, 1), spoilt(11, 1);
  layer(W.data(), 11, X.data(), 11, 3, clean.data(), 11, 1, 11, true);
  for (Index bad = 0; bad < 11; ++bad) {
    Matrix Y = X;
    Y(bad, 1) = kNaN;
    layer(W.data(), 11, Y.data(), 11, 3, spoilt.data(), 11, 1, 11, true);
    for (Index r = 0; r < 11; ++r) EXPECT_TRUE(r == bad ? std::isnan(spoilt(r, 0)) : spoilt(r, 0) == clean(r, 0));
  }
}

}  // namespace
}  // namespace rehearse::policy
