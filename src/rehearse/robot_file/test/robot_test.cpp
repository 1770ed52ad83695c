#include "rehearse/robot_file/robot.hpp"

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"

namespace rehearse::robot_file {
namespace {

TEST(Robot, SaysTheEquationOfADynamics) {
  const Robot robot = read(example::kSwing, "swing.toml", example::no_files);
  const system::OdeFormulas equation = robot.equation(robot.dynamics_of(robot.plant));
  EXPECT_EQ(equation.states, (std::vector<std::string>{"rate", "angle"}));
  EXPECT_EQ(equation.actions, std::vector<std::string>{"u"});
  EXPECT_EQ(equation.parameters, (std::vector<std::string>{"m", "l"}));
  EXPECT_EQ(equation.angles, std::vector<std::string>{"angle"});
  EXPECT_EQ(equation.slopes, (std::vector<std::string>{"torque / (m * l^2)", "rate"}));
}

}  // namespace
}  // namespace rehearse::robot_file
