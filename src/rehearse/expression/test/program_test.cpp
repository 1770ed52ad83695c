#include "rehearse/expression/program.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace rehearse::expression {
namespace {

TEST(Program, ComputesAllRowsWhateverTheirNumber) {
  Formulas formulas;
  formulas.input("x", Pace::always);
  formulas.input("y", Pace::always);
  const Program program(formulas, {formulas.compile("x * y + 1"), formulas.compile("3"), formulas.compile("y")});
  EXPECT_EQ(program.inputs(), 2);
  EXPECT_EQ(program.outputs(), 3);
  for (const Index rows : {1, 8, 63, 64, 65, 200}) {
    const Vector x = Vector::LinSpaced(rows, -1, 2), y = Vector::LinSpaced(rows, 3, 5);
    Matrix results(rows, 3);
    program.run({x.data(), y.data()}, results);
    for (Index i = 0; i < rows; ++i) {
      EXPECT_EQ(results(i, 0), std::fma(x(i), y(i), 1));
      EXPECT_EQ(results(i, 1), 3);
      EXPECT_EQ(results(i, 2), y(i));
    }
  }
}

TEST(Program, IsAffineAsItIsWritten) {
  Formulas formulas;
  formulas.input("x", Pace::always);
  formulas.input("y", Pace::call);
  const auto is_affine = [&](const char* formula) {
    return Program(formulas, {formulas.compile(formula)}).is_affine();
  };
  for (const char* formula : {"3", "y", "2 * x - y / 4 + 1e9", "-(x + sin(1) * y)", "x * (2 - 1) + where(1, 2, 3)"})
    EXPECT_TRUE(is_affine(formula)) << formula;
  for (const char* formula : {"x * y", "1 / x", "abs(x)", "max(x - 5, 0)", "x ^ 2", "sin(y)", "where(x > 9, x, 0)"})
    EXPECT_FALSE(is_affine(formula)) << formula;
}

}  // namespace
}  // namespace rehearse::expression
