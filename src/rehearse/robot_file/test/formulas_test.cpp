#include "rehearse/robot_file/formulas.hpp"

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"

namespace rehearse::robot_file {
namespace {

using example::with, example::no_files;

std::string unknown(expression::Formulas formulas, const std::string& formula) {
  try {
    formulas.compile(formula);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(RobotFormulas, KnowStatesOrStepsOrAllOfAStep) {
  const Robot robot = read(example::kSwing, "swing.toml", example::no_files);
  const expression::Program of_costs =
      program(formulas_of(robot, Of::costs), {Formula{"height + 10 * u + 100 * u_before + 1000 * time"}});
  EXPECT_DOUBLE_EQ(evaluate(of_costs, Matrix{{7, 0}}, Matrix{{2, 3, 4}})(0, 0), 1 + 20 + 300 + 4000);
  EXPECT_NE(unknown(formulas_of(robot, Of::states), "u").find("u_last"), std::string::npos);
  for (const Of of : {Of::states, Of::steps})
    for (const char* formula : {"u_before", "time"}) {
      const std::string line = unknown(formulas_of(robot, of), formula);
      EXPECT_NE(line.find("`cost` of [reward]"), std::string::npos) << line;
      EXPECT_NE(line.find("`keep` of a [[limit]]"), std::string::npos) << line;
    }
}

TEST(RobotFormulas, SayThatParametersAreOfTheDynamics) {
  const Robot robot = read(example::kSwing, "swing.toml", no_files);
  for (const Of of : {Of::states, Of::steps, Of::costs})
    EXPECT_EQ(unknown(formulas_of(robot, of), "l * angle"),
              "'l' is a parameter, which the formulas of [dynamics.pendulum] alone know");
  const Robot own = read(with("[define]", "[define]\nl = 0.5"), "swing.toml", no_files);
  EXPECT_EQ(unknown(formulas_of(own, Of::states), "l * angle"), "");
}

TEST(RobotFormulas, DefinitionsMayUseWhatTheFormulaThatUsesThemMay) {
  const Robot robot =
      read(with("[define]", "[define]\njerk = \"(u - u_before)^2\"\nearly = \"time < 1\""), "swing.toml", no_files);
  const expression::Program of_costs = program(formulas_of(robot, Of::costs), {Formula{"10 * jerk + early"}});
  EXPECT_DOUBLE_EQ(evaluate(of_costs, Matrix{{7, 0}}, Matrix{{2, 5, 0.5}})(0, 0), 91);
  EXPECT_DOUBLE_EQ(evaluate(of_costs, Matrix{{7, 0}}, Matrix{{2, 5, 2}})(0, 0), 90);
  EXPECT_NE(unknown(formulas_of(robot, Of::steps), "jerk").find("'u_before', which the definition of 'jerk' uses, is "),
            std::string::npos);
}

TEST(RobotFormulas, ARobotsOwnNamesHideActionsBeforeAndTime) {
  const Robot robot = read(with("[define]", "[define]\ntime = \"3\"\nu_before = \"rate\""), "swing.toml", no_files);
  EXPECT_TRUE(is_own_name(robot, "time"));
  EXPECT_FALSE(is_own_name(robot, "angle_before"));
  const expression::Program of_costs = program(formulas_of(robot, Of::costs), {Formula{"u_before + 100 * time"}});
  EXPECT_DOUBLE_EQ(evaluate(of_costs, Matrix{{7, 0}}, Matrix{{2, 5, 0.5}})(0, 0), 307);
}

}  // namespace
}  // namespace rehearse::robot_file
