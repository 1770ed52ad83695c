#include "rehearse/expression/tape_builder.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "run_formula.hpp"

namespace rehearse::expression {
namespace {

std::size_t length(const Tape& tape) { return tape.code[0].size() + tape.code[1].size() + tape.code[2].size(); }

TEST(TapeBuilder, TheSameOperationIsDoneOnce) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always), y = builder.input(Pace::always);
  EXPECT_EQ(builder.operation(Op::add, x, y), builder.operation(Op::add, y, x));
  EXPECT_NE(builder.operation(Op::subtract, x, y), builder.operation(Op::subtract, y, x));
}

TEST(TapeBuilder, ConstantsAreComputedAtOnce) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always);
  const Node six = builder.operation(Op::multiply, builder.constant(2), builder.constant(3));
  EXPECT_EQ(*builder.constant_of(six), 6);
  EXPECT_EQ(builder.constant_of(x), nullptr);
  EXPECT_EQ(builder.operation(Op::add, x, builder.constant(0)), x);
  EXPECT_EQ(builder.operation(Op::multiply, builder.constant(1), x), x);
  EXPECT_EQ(builder.operation(Op::divide, x, builder.constant(1)), x);
}

TEST(TapeBuilder, KnowsWhatIsACondition) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always), one = builder.constant(1);
  const Node less = builder.operation(Op::less, x, builder.constant(2)), no = builder.operation(Op::logical_not, x);
  const Node both = builder.operation(Op::logical_and, less, no);
  for (const Node node : {one, builder.constant(0), less, no, both, builder.operation(Op::where, x, less, one),
                          builder.operation(Op::multiply, less, no)})
    EXPECT_TRUE(builder.is_condition(node)) << node;
  for (const Node node : {x, builder.constant(2), builder.operation(Op::sine, x), builder.operation(Op::add, less, no),
                          builder.operation(Op::where, less, x, one), builder.operation(Op::multiply, less, x)})
    EXPECT_FALSE(builder.is_condition(node)) << node;
}

TEST(TapeBuilder, SumsOfProductsAreFusedAndWhatNobodyNeedsIsLeftOut) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always), y = builder.input(Pace::always);
  builder.operation(Op::sine, x);
  const Node sum = builder.operation(Op::add, builder.operation(Op::multiply, x, y), x);
  const Tape tape = builder.tape({sum});
  ASSERT_EQ(length(tape), 1u);
  EXPECT_EQ(tape.code[2][0].op, Op::multiply_add);
  EXPECT_EQ(run_tape(tape, Matrix{{2, 3}, {4, 5}}), (Matrix{{8}, {24}}));
}

TEST(TapeBuilder, EveryValueIsComputedAtThePaceOfItsInputs) {
  TapeBuilder builder;
  const Node phi = builder.input(Pace::call), u = builder.input(Pace::block), x = builder.input(Pace::always);
  const Node square = builder.operation(Op::multiply, phi, phi), push = builder.operation(Op::add, square, u);
  const Tape tape = builder.tape({builder.operation(Op::multiply, push, x)});
  for (const auto& code : tape.code)
    EXPECT_EQ(code.size(), 1u) << "and no product is fused into a sum of a faster pace";
  EXPECT_EQ(run_tape(tape, Matrix{{2, 3, 5}}), (Matrix{{35}}));
}

// 1 / ((x + y) y): two instructions hand their results over, and no slot is taken but that of the output.
TEST(TapeBuilder, AResultThatTheNextInstructionAloneNeedsIsNotStored) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always), y = builder.input(Pace::always);
  const Node sum = builder.operation(Op::add, x, y), ratio = builder.operation(Op::multiply, sum, y);
  const Tape chain = builder.tape({builder.operation(Op::divide, builder.constant(1), ratio)});
  ASSERT_EQ(chain.code[2].size(), 3u);
  EXPECT_FALSE(chain.code[2][0].is_stored);
  EXPECT_EQ(chain.code[2][1].in_registers, Argument::b);
  EXPECT_EQ(chain.code[2][2].in_registers, Argument::b);
  EXPECT_TRUE(chain.code[2][2].is_stored);
  EXPECT_EQ(chain.slots, chain.slots_of_inputs() + 1);

  const Tape twice = builder.tape({builder.operation(Op::multiply, sum, sum)});
  EXPECT_TRUE(twice.code[2][0].is_stored) << "a square needs it in memory";
  const Tape of_output = builder.tape({ratio, sum});
  EXPECT_TRUE(of_output.code[2][0].is_stored) << "an output";
  const Tape called = builder.tape({builder.operation(Op::tangent, sum)});
  EXPECT_TRUE(called.code[2][0].is_stored) << "operations that go from memory to memory";
}

TEST(TapeBuilder, OperationsThatAreNestedTooDeeplyAreRefused) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always);
  Node sum = x;
  const auto nest = [&](int times) {
    for (int i = 0; i < times; ++i) sum = builder.operation(Op::add, sum, x);
  };
  nest(10000);
  EXPECT_EQ(run_tape(builder.tape({sum}), Matrix{{2}})(0, 0), 20002);
  EXPECT_THROW(nest(1), InvalidInput);
}

TEST(TapeBuilder, SlotsAreUsedAgain) {
  TapeBuilder builder;
  const Node x = builder.input(Pace::always);
  Node chain = x;
  for (int i = 0; i < 100; ++i) chain = builder.operation(Op::hyperbolic_tangent, chain);
  EXPECT_LE(builder.tape({chain}).slots, 3);
}

}  // namespace
}  // namespace rehearse::expression
