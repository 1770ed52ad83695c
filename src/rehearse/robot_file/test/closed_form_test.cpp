#include "rehearse/robot_file/closed_form.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/task.hpp"

namespace rehearse::robot_file {
namespace {

using example::kSwing, example::with;

Robot rewarded(const std::string& formula) {
  return read(with("distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5", "formula = \"" + formula + "\""),
              "swing.toml", example::no_files);
}

TEST(ClosedForm, DistancesOfFeaturesHaveAClosedForm) {
  const auto form = closed_form(read(kSwing, "swing.toml", example::no_files));
  ASSERT_TRUE(form);
  const Vector goal{{0.0, 1.0, 0.0}};  // rate, cos, sin
  EXPECT_LT((form->distances * (form->goal - goal)).norm(), 1e-12);
  const Vector features{{2, std::cos(1), std::sin(1)}};
  const double d2 = (form->distances * (features - form->goal)).squaredNorm();
  EXPECT_NEAR(d2, (std::pow(1 - std::cos(1), 2) + std::pow(std::sin(1), 2)) / 0.25, 1e-12);
}

TEST(ClosedForm, LargeDistancesHaveAClosedForm) {
  const auto form =
      closed_form(read(with("\"sin(angle)\"]", "\"3e7 * sin(angle) + 2e8\"]"), "swing.toml", example::no_files));
  ASSERT_TRUE(form);
  const Vector features{{2, std::cos(1), std::sin(1)}};
  EXPECT_NEAR((form->distances * (features - form->goal)).tail(1)(0), (3e7 * std::sin(1) + 2e8) / 0.5, 1e-4);
}

TEST(ClosedForm, OtherDistancesHaveNone) {
  for (const char* distance :
       {"angle", "height^2", "sin(2 * angle)", "rate * height", "abs(rate)", "max(rate - 5, 0)", "abs(rate + 3)"})
    EXPECT_FALSE(closed_form(
        read(with("\"sin(angle)\"]", "\"" + std::string(distance) + "\"]"), "swing.toml", example::no_files)))
        << distance;
}

TEST(ClosedForm, OfAFormulaIsThatOfItsExponent) {
  for (const char* formula :
       {"exp(-((1 - height)^2 + sin(angle)^2) / (2 * 0.5^2))", "exp(-0.5 * (rate / 3 - height)^2)",
        "exp(-(rate - 2)^2 - 3 * (cos(angle) + rate - 4)^2)", "exp(-(rate^2 - 4 * rate + 4))"}) {
    const Robot robot = rewarded(formula);
    const auto form = closed_form(robot);
    ASSERT_TRUE(form) << formula;
    const Task task = make_task(robot);
    ASSERT_TRUE(reward::closed_form(task.reward)) << formula;
    for (const double angle : {0.0, 1.0, -2.5}) {
      const Matrix X{{2.5, angle}};
      Vector earned(1);
      task.reward(X, Matrix{{0}}, X, earned);
      const Vector features{{2.5, std::cos(angle), std::sin(angle)}};
      EXPECT_NEAR(earned(0), std::exp(-0.5 * (form->distances * (features - form->goal)).squaredNorm()), 1e-12)
          << formula;
    }
  }
}

TEST(ClosedForm, OfOtherFormulasThereIsNone) {
  for (const char* formula :
       {"height", "1 - exp(-rate^2)", "2 * exp(-rate^2)", "exp(rate^2)", "exp(-rate)", "exp(-1 - rate^2)",
        "exp(-angle^2)", "exp(-angle * height)", "exp(-rate^2 - u^2)", "exp(-abs(rate)^2)", "exp(-rate^4)",
        "exp(-rate^2 + height^2)", "exp(-rate^2 - height)", "exp(-1)"}) {
    EXPECT_FALSE(closed_form(rewarded(formula))) << formula;
    EXPECT_FALSE(reward::closed_form(make_task(rewarded(formula)).reward)) << formula;
  }
}

TEST(ClosedForm, WhereAStateThatIsNoFeaturePlaysAPartThereIsNone) {
  const auto form = [](const std::string& reward) {
    std::string text = with("[[action]]", "[[state]]\nname = \"place\"\ninput = false\nrate = \"rate\"\n[[action]]");
    const std::string own = "distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5";
    text.replace(text.find(own), own.size(), reward);
    return closed_form(read(text, "swing.toml", example::no_files));
  };
  for (const char* distance : {"place", "rate - 2 * place"})
    EXPECT_FALSE(form("distance = [\"" + std::string(distance) + "\"]\nwidth = 1")) << distance;
  for (const char* formula : {"exp(-place^2)", "exp(-(rate - place)^2)", "exp(-rate^2 - place)"})
    EXPECT_FALSE(form("formula = \"" + std::string(formula) + "\"")) << formula;
  for (const char* reward : {"distance = [\"rate\"]\nwidth = 1", "formula = \"exp(-rate^2 + 0 * place)\""})
    EXPECT_TRUE(form(reward)) << reward;
}

}  // namespace
}  // namespace rehearse::robot_file
