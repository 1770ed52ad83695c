#include "rehearse/robot_file/robot_formulas.hpp"

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"

namespace rehearse::robot_file {
namespace {

TEST(RobotFormulas, OfStepsKnowActionsBehindTheStates) {
  const Robot robot = read(example::kSwing, "swing.toml", example::no_files);
  const expression::Program of_steps = program(formulas_of(robot, Of::steps), {Formula{"rate + 2 * angle + 4 * u", 1}});
  EXPECT_EQ(evaluate(of_steps, Matrix{{1, 2}, {3, 4}}, Matrix{{5}, {6}}), (Matrix{{25}, {35}}));
  EXPECT_EQ(formulas_of(robot, Of::states).compile("angle"), inputs_of(robot, Of::steps).compile("angle"));
  EXPECT_THROW(formulas_of(robot, Of::states).compile("u"), InvalidInput);
  EXPECT_THROW(inputs_of(robot, Of::states).compile("height"), InvalidInput) << "a definition";
}

}  // namespace
}  // namespace rehearse::robot_file
