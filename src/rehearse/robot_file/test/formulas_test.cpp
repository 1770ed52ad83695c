#include "rehearse/robot_file/formulas.hpp"

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"

namespace rehearse::robot_file {
namespace {

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
      program(formulas_of_costs(robot), {Formula{"height + 10 * u + 100 * u_before + 1000 * time"}});
  EXPECT_DOUBLE_EQ(evaluate(of_costs, Matrix{{7, 0}}, Matrix{{2, 3, 4}})(0, 0), 1 + 20 + 300 + 4000);
  EXPECT_NE(unknown(formulas_of(robot, Of::states), "u").find("u_last"), std::string::npos);
  for (const Of of : {Of::states, Of::steps})
    for (const char* formula : {"u_before", "time"}) {
      const std::string line = unknown(formulas_of(robot, of), formula);
      EXPECT_NE(line.find("`cost` of [reward]"), std::string::npos) << line;
      EXPECT_NE(line.find("`keep` of a [[limit]]"), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace rehearse::robot_file
