#include "rehearse/robot_file/variant.hpp"

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"

namespace rehearse::robot_file {
namespace {

using example::complaint_of, example::kSwing, example::with;

TEST(RobotVariant, HasTheValuesOfItsDynamicsAndItsOwn) {
  const Robot robot = read(with("[plant]", "[plant]\nparameters.l = 0.7"), "swing.toml", example::no_files);
  EXPECT_EQ(robot.plant.parameters.values(), (Vector{{1, 0.7}}));
  EXPECT_EQ(robot.priors[0].parameters.values(), (Vector{{1.3, 0.5}}));
}

TEST(RobotVariant, IsOfTheFirstDynamicsUnlessItSaysAnother) {
  const std::string text = with("[plant]", "[dynamics.a]\nrate.rate = \"u\"\n[plant]\n");
  const Robot robot = read(text + "[prior.b]\ndynamics = \"a\"\n", "swing.toml", example::no_files);
  EXPECT_EQ(robot.plant.dynamics, "pendulum");
  EXPECT_EQ(robot.priors[0].dynamics, "pendulum");
  EXPECT_EQ(robot.priors[1].dynamics, "a");
}

TEST(RobotVariant, ParametersMayHaveChoices) {
  const Robot robot =
      read(with("tune.m = [0.5, 2]", "tune.m = { choices = [1, 1.3, 2] }"), "swing.toml", example::no_files);
  EXPECT_EQ(robot.priors[0].parameters[0].choices, (std::vector<double>{1, 1.3, 2}));
}

TEST(RobotVariant, AStartOutsideItsBoundsIsRefused) {
  EXPECT_NE(complaint_of(with("tune.m = [0.5, 2]", "tune.m = [0.5, 1]")), "");
  EXPECT_NE(complaint_of(with("tune.m = [0.5, 2]", "tune.m = { choices = [1, \"a\"] }")), "");
  EXPECT_NE(complaint_of(with("tune.m = [0.5, 2]", "tune.m = { choice = [1] }")), "");
}

}  // namespace
}  // namespace rehearse::robot_file
