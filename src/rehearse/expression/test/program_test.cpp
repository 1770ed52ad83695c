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

TEST(Program, HasTheDegreeThatIsWritten) {
  Formulas formulas;
  formulas.input("x", Pace::always);
  formulas.input("y", Pace::call);
  const auto degree = [&](const char* formula) { return Program(formulas, {formulas.compile(formula)}).degree(); };
  EXPECT_EQ(degree("3 + sin(1)"), 0);
  for (const char* formula : {"y", "2 * x - y / 4 + 1e9", "-(x + sin(1) * y)", "x * (2 - 1) + where(1, 2, 3)"})
    EXPECT_EQ(degree(formula), 1) << formula;
  for (const char* formula : {"x * y", "x ^ 2", "3 - (x - 2 * y)^2 / 0.5^2", "x - y * x"})
    EXPECT_EQ(degree(formula), 2) << formula;
  for (const char* formula : {"1 / x", "abs(x)", "max(x - 5, 0)", "x ^ 3", "sin(y)", "where(x > 9, x, 0)", "x * x / x",
                              "abs(x) * 0.5", "x ^ 2 * y"})
    EXPECT_EQ(degree(formula), Program::kNoPolynomial) << formula;
  EXPECT_EQ(Program(formulas, {formulas.compile("x"), formulas.compile("x * y")}).degree(), 2);
}

}  // namespace
}  // namespace rehearse::expression
