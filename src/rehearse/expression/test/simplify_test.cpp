#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/expression/tape_builder.hpp"
#include "run_formula.hpp"

namespace rehearse::expression {
namespace {

TEST(Simplify, SmallPowersAreProducts) {
  for (int n = -4; n <= 5; ++n) {
    TapeBuilder builder;
    const Node x = builder.input(Pace::always);
    const Tape tape = builder.tape({builder.operation(Op::power, x, builder.constant(n))});
    EXPECT_NEAR(run_tape(tape, Matrix{{-1.5}})(0, 0), std::pow(-1.5, n), 1e-14) << n;
    for (const Instruction& instruction : tape.code[2]) EXPECT_NE(instruction.op, Op::power);
  }
}

TEST(Simplify, SinesOfSumsFollowFromThoseThatAreKnown) {
  TapeBuilder builder;
  const Node a = builder.input(Pace::always), b = builder.input(Pace::always);
  const Node sine_a = builder.input(Pace::always), cosine_a = builder.input(Pace::always),
             sine_b = builder.input(Pace::always), cosine_b = builder.input(Pace::always);
  builder.known_trigonometry(a, sine_a, cosine_a);
  builder.known_trigonometry(b, sine_b, cosine_b);
  EXPECT_EQ(builder.operation(Op::sine, a), sine_a);
  const Node difference = builder.operation(Op::subtract, a, b), both = builder.operation(Op::add, difference, a);
  const Tape tape = builder.tape({builder.operation(Op::sine, both), builder.operation(Op::cosine, both)});
  for (const Instruction& instruction : tape.code[2]) {
    EXPECT_NE(instruction.op, Op::sine);
    EXPECT_NE(instruction.op, Op::cosine);
  }
  const double x = 0.7, y = -1.3;
  const Matrix at{{x, y, std::sin(x), std::cos(x), std::sin(y), std::cos(y)}};
  EXPECT_NEAR(run_tape(tape, at)(0, 0), std::sin(2 * x - y), 1e-15);
  EXPECT_NEAR(run_tape(tape, at)(0, 1), std::cos(2 * x - y), 1e-15);
}

TEST(Simplify, DivisionsByTheSameNumberAreOneDivision) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always), y = builder.input(Pace::always);
  const Tape tape = builder.tape(
      {builder.operation(Op::divide, x, y), builder.operation(Op::divide, builder.operation(Op::sine, x), y)});
  EXPECT_EQ(std::ranges::count(tape.code[2], Op::divide, &Instruction::op), 1);
}

TEST(Simplify, WhatJumpsAtAQuotientSeesItRoundedOnce) {
  for (int i = 1; i <= 1000; ++i) {
    EXPECT_EQ(value_of("floor(x / y)", 3.0 * i, i), 3) << i;
    EXPECT_EQ(value_of("ceil(x / y)", 3.0 * i, i), 3) << i;
    EXPECT_EQ(value_of("x - y * floor(x / y)", i, i), 0) << i;
    EXPECT_EQ(value_of("x / y == 1", i, i), 1) << i;
    EXPECT_EQ(value_of("1 <= x / y", i, i), 1) << i;
  }
}

}  // namespace
}  // namespace rehearse::expression
