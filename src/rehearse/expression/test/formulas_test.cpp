#include "rehearse/expression/formulas.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "run_formula.hpp"

namespace rehearse::expression {
namespace {

TEST(Formulas, FollowTheRulesOfArithmetic) {
  EXPECT_EQ(value_of("2 + 3 * 4"), 14);
  EXPECT_EQ(value_of("(2 + 3) * 4"), 20);
  EXPECT_EQ(value_of("2 - 3 - 4"), -5);
  EXPECT_EQ(value_of("-x^2", 3), -9);
  EXPECT_EQ(value_of("2^3^2"), 512);
  EXPECT_EQ(value_of("x / y / 2", 12, 3), 2);
  EXPECT_EQ(value_of("x - -y", 1, 2), 3);
  EXPECT_EQ(value_of("1e-3 * x", 2), 2e-3);
  EXPECT_NEAR(value_of("sin(pi / 2) + atan2(x, y)", 1, 1), 1 + std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(value_of("max(x, y) + clamp(x, -1, 1)", 5, 7), 8);
}

TEST(Formulas, CompareAndChoose) {
  EXPECT_EQ(value_of("x < y", 1, 2), 1);
  EXPECT_EQ(value_of("x > y", 1, 2), 0);
  EXPECT_EQ(value_of("x >= 1 && y <= 2", 1, 2), 1);
  EXPECT_EQ(value_of("x == 2 || y != 2", 1, 2), 0);
  EXPECT_EQ(value_of("!(x < y)", 1, 2), 0);
  EXPECT_EQ(value_of("2 == x", 2), 1) << "a number first";
  EXPECT_EQ(value_of("where(abs(x) < 1, x, y)", 0.5, 7), 0.5);
  EXPECT_EQ(value_of("where(abs(x) < 1, x, y)", 1.5, 7), 7);
}

TEST(Formulas, MayUseDefinitionsInAnyOrder) {
  Formulas formulas;
  const Node x = formulas.input("x", Pace::always);
  formulas.define("twice_square", "2 * square");
  formulas.define("square", "x * x");
  EXPECT_EQ(formulas.named("x"), x);
  const Tape tape = formulas.builder().tape({formulas.compile("twice_square + square")});
  EXPECT_EQ(run_tape(tape, Matrix{{3}}), (Matrix{{27}}));
}

std::string complaint_of(const std::string& formula) {
  Formulas formulas;
  formulas.input("theta1", Pace::always);
  formulas.define("a", "b + 1");
  formulas.define("b", "a + 1");
  formulas.define("broken", "1 +");
  try {
    formulas.compile(formula);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

// Each needs the one before, and none is compiled yet.
TEST(Formulas, AChainOfDefinitionsHasAnEnd) {
  Formulas formulas;
  formulas.input("x0", Pace::always);
  for (int i = 1; i <= 501; ++i) formulas.define(fmt::format("x{}", i), fmt::format("x{} + 1", i - 1));
  EXPECT_THROW(formulas.compile("x501"), InvalidInput);
  EXPECT_NO_THROW(formulas.compile("x500"));
  EXPECT_NO_THROW(formulas.compile("x501")) << "the others are known by now";
}

TEST(Formulas, ErrorsSayWhatIsWrong) {
  EXPECT_EQ(complaint_of("theta + 1"), "unknown name 'theta', did you mean 'theta1'? (known: theta1, a, b, broken)");
  EXPECT_EQ(complaint_of("a"), "the definition of 'a' needs itself: a → b → a");
  EXPECT_EQ(complaint_of("theta1 ? 1 : 2"), "'a ? b : c' is written where(a, b, c)");
  EXPECT_EQ(complaint_of("theta1 > 0 and theta1 < 1"), "'a and b' is written a && b");
  EXPECT_EQ(complaint_of("theta1 > 0 or theta1 < 1"), "'a or b' is written a || b");
  EXPECT_EQ(complaint_of("theta1 ** 2"), "'a ** b' is written a ^ b");
  EXPECT_EQ(complaint_of("theta1 = 2"), "'a = b' is written a == b");
  for (const char* right : {"theta1 == 2", "theta1 <= 2", "theta1 >= 2", "theta1 != 2"})
    EXPECT_EQ(complaint_of(right), "") << right;
  EXPECT_EQ(complaint_of("ln(theta1)"), "unknown name 'ln': 'ln(a)' is written log(a)");
  EXPECT_EQ(complaint_of("mod(theta1, 2)"), "unknown name 'mod': 'mod(a, b)' is written a - b * floor(a / b)");
  for (const char* wrong : {"", "1 +", "sin()", "sin(1, 2)", "(theta1", "theta1)", "theta1 theta1", "1..2", "min(1)",
                            "theta1 = 2", "\"text\"", "sin", "broken", "theta1 $ 2", "1 < "})
    EXPECT_NE(complaint_of(wrong), "") << wrong;
}

// muParser has a result for each of them, the last first.
TEST(Formulas, ACommaIsNoDecimalPoint) {
  EXPECT_EQ(complaint_of("1,5 - theta1"),
            "'1,5 - theta1': a comma outside of a function's brackets; decimals are written 1.5");
  EXPECT_NE(complaint_of("theta1^2 / 3, 7").find("a comma outside"), std::string::npos);
  EXPECT_NE(complaint_of("1, 2"), "");
  EXPECT_NE(complaint_of("(1, 5) - theta1"), "");
  EXPECT_EQ(complaint_of("max(1, 5) - theta1"), "");
}

TEST(Formulas, ComparisonsAreNoChains) {
  for (const char* chain : {"0.9 < theta1 < 1.1", "1 >= theta1 > 0", "1 < 2 < theta1", "theta1 < (theta1 <= 1)"})
    EXPECT_EQ(complaint_of(chain), "'a < b < c' is written a < b && b < c") << chain;
  EXPECT_EQ(value_of("0.9 < x && x < y", 1, 2), 1);
  EXPECT_EQ(value_of("(x < 2) == (y < 2)", 1, 1), 1);
  Formulas formulas;
  formulas.input("x", Pace::always);
  formulas.define("small", "x < 2");
  EXPECT_EQ(run_tape(formulas.builder().tape({formulas.compile("small > 0.5")}), Matrix{{1}}), (Matrix{{1}}))
      << "a definition is a number";
}

TEST(Formulas, NamesOfOtherFormulasAreExplained) {
  Formulas formulas;
  formulas.elsewhere("time", "is known to costs alone");
  formulas.define("phase", "2 * time");
  const auto expect = [&](const char* formula, const char* said) {
    try {
      formulas.compile(formula);
      FAIL();
    } catch (const InvalidInput& error) {
      EXPECT_STREQ(error.what(), said);
    }
  };
  expect("2 * time", "'time' is known to costs alone");
  for (const char* formula : {"sin(phase)", "phase"})
    expect(formula, "'time', which the definition of 'phase' uses, is known to costs alone");
  formulas.input("time", Pace::always);
  EXPECT_NO_THROW(formulas.compile("time"));
}

TEST(Formulas, NamesAreNamesAndGivenOnce) {
  Formulas formulas;
  formulas.input("x", Pace::always);
  for (const char* wrong : {"", "1x", "x y", "x", "sin", "pi", "θ"}) {
    EXPECT_THROW(formulas.input(wrong, Pace::always), InvalidInput) << wrong;
    EXPECT_THROW(formulas.define(wrong, "1"), InvalidInput) << wrong;
  }
}

}  // namespace
}  // namespace rehearse::expression
