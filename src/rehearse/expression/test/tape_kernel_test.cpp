#include "rehearse/expression/tape_kernel.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/expression/scalar.hpp"
#include "run_formula.hpp"

namespace rehearse::expression {
namespace {

/// Every operation as a tape of its own.
Tape tape_of(Op op) {
  TapeBuilder builder;
  Node arguments[3] = {TapeBuilder::kNone, TapeBuilder::kNone, TapeBuilder::kNone};
  for (int i = 0; i < arguments_of(op); ++i) arguments[i] = builder.input(Pace::always);
  return builder.tape({builder.operation(op, arguments[0], arguments[1], arguments[2])});
}

class EachOperation : public ::testing::TestWithParam<int> {};

// Against the C library, at numbers of all kinds, NaN and infinity among them.
TEST_P(EachOperation, IsThatOfSingleNumbers) {
  const auto op = static_cast<Op>(GetParam());
  const double values[] = {0, 1, -1, 0.3, -2.5, 0.99, 1e4, 1e-9, NAN, INFINITY};
  for (const double a : values)
    for (const double b : values) {
      const double c = 2;
      const Matrix in = Matrix{{a, b, c}}.leftCols(arguments_of(op));
      const double got = run_tape(tape_of(op), in)(0, 0), expected = evaluate(op, a, b, c);
      if (std::isnan(expected))
        EXPECT_TRUE(std::isnan(got)) << GetParam() << " of " << a << ", " << b << ": " << got;
      else if (std::isinf(expected) || expected == 0)
        EXPECT_EQ(got, expected) << GetParam() << " of " << a << ", " << b;
      else
        EXPECT_NEAR(got / expected, 1, 1e-14) << GetParam() << " of " << a << ", " << b;
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachOperation, ::testing::Range(0, static_cast<int>(Op::where) + 1));

// An operation on x + y and two inputs, x + y as each of its arguments, for as many rows as a processor has together or
// not.
TEST(TapeKernel, EachArgumentMayComeFromRegisters) {
  for (int number = 0; number <= static_cast<int>(Op::where); ++number)
    for (int place = 0; place < arguments_of(static_cast<Op>(number)); ++place) {
      const auto op = static_cast<Op>(number);
      TapeBuilder builder;
      const Node x = builder.input(Pace::always), y = builder.input(Pace::always), z = builder.input(Pace::always);
      Node arguments[3] = {y, z, x};
      arguments[place] = builder.operation(Op::add, x, y);
      for (int i = arguments_of(op); i < 3; ++i) arguments[i] = TapeBuilder::kNone;
      const Tape tape = builder.tape({builder.operation(op, arguments[0], arguments[1], arguments[2])});
      Matrix in(kBlock, 3);
      for (Index k = 0; k < kBlock; ++k)
        in.row(k) << 0.3 + 0.1 * static_cast<double>(k), 1.7, -0.25 * static_cast<double>(k);
      for (const Index rows : {Index{1}, Index{17}, kBlock}) {
        const Matrix out = run_tape(tape, in.topRows(rows));
        for (Index k = 0; k < rows; ++k) {
          double values[3] = {in(k, 1), in(k, 2), in(k, 0)};
          values[place] = in(k, 0) + in(k, 1);
          const double expected = evaluate(op, values[0], values[1], values[2]);
          if (std::isnan(expected))
            EXPECT_TRUE(std::isnan(out(k, 0))) << number << " at " << place;
          else if (std::isinf(expected) || expected == 0)
            EXPECT_EQ(out(k, 0), expected) << number << " at " << place;
          else
            EXPECT_NEAR(out(k, 0) / expected, 1, 1e-13) << number << " at " << place << ", row " << k;
        }
      }
    }
}

TEST(TapeKernel, ARowDoesNotDependOnTheOthers) {
  Formulas formulas;
  formulas.input("x", Pace::always);
  const Tape tape = formulas.builder().tape({formulas.compile("sin(x) * exp(-x^2) + tanh(x) / (2 + x)")});
  Matrix inputs(kBlock, 1);
  for (Index i = 0; i < kBlock; ++i) inputs(i, 0) = 0.1 * static_cast<double>(i) - 3;
  const Matrix all = run_tape(tape, inputs);
  for (const Index rows : {1, 7, 8, 9, 33}) EXPECT_EQ(run_tape(tape, inputs.topRows(rows)), all.topRows(rows));
}

// x' = −x: the error of a fifth-order step of 0.1 is some 1e-9.
TEST(TapeKernel, IntegratesToFifthOrder) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always);
  const Tape tape = builder.tape({builder.operation(Op::negate, x)});
  const auto error = [&](Index steps) {
    alignas(64) double slots[8 * kBlock], work[7 * kBlock];
    double* state = slots + tape.input_slot(0) * kBlock;
    std::fill_n(state, kBlock, 1.0);
    const BlockOde ode{
        {tape.code[2].data(), static_cast<Index>(tape.code[2].size())}, tape.outputs.data(), 1, tape.input_slot(0)};
    integrate(ode, {slots, kBlock}, work, 1.0 / static_cast<double>(steps), steps);
    EXPECT_EQ(state[0], state[kBlock - 1]);
    return std::abs(state[0] - std::exp(-1));
  };
  EXPECT_LT(error(10), 1e-8);
  EXPECT_NEAR(std::log2(error(4) / error(8)), 5, 0.5);
}

}  // namespace
}  // namespace rehearse::expression
