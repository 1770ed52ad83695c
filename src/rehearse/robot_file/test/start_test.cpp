#include "rehearse/robot_file/start.hpp"

#include <gtest/gtest.h>

#include "example.hpp"

namespace rehearse::robot_file {
namespace {

using example::complaint_of, example::kSwing, example::with;

const std::string kDistance = "distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5";

TEST(RobotStart, AFormulaWithoutAFiniteValueIsRefused) {
  const auto expect = [](const std::string& part, const std::string& by, const std::string& said) {
    EXPECT_EQ(complaint_of(with(part, by)), "swing.toml: line " + said) << by;
  };
  expect(kDistance, "formula = \"u / rate\"",
         "25: reward.formula: \"u / rate\" is not finite at the start (rate = 0, u = 0 N m)");
  expect("\"sin(angle)\"]", "\"1 / rate\"]", "25: reward.distance: \"1 / rate\" is not finite at the start (rate = 0)");
  expect("\"sin(angle)\"]", "\"sqrt(height)\"]",
         "25: reward.distance: \"sqrt(height)\" is not finite at the start (height = -0.989992)");
  expect("width = 0.5", "width = 0.5\ncost = \"u_before / time\"",
         "27: reward.cost: \"u_before / time\" is not finite at the start (u_before = 0 N m, time = 0 s)");
  expect("dt_s = 0.1", "dt_s = 0.1\nended = \"angle > 2\"", "4: ended: \"angle > 2\" holds at the start (angle = 3)");
}

TEST(RobotStart, RatesHaveTheParametersOfPlantAndPriors) {
  EXPECT_EQ(complaint_of(with("[plant]", "[plant]\nparameters.l = 0")),
            "swing.toml: line 35: plant: rate.rate: \"torque / (m * l^2)\" is not finite at the start (m = 1, l = 0 m, "
            "torque = 0)");
  EXPECT_NE(complaint_of(with("parameters.m = 1.3\ntune.m = [0.5, 2]", "parameters.m = 0"))
                .find("line 35: prior heavy: rate.rate: "),
            std::string::npos);
  EXPECT_NE(complaint_of(with("define.torque = \"u", "define.I = 0\ndefine.torque = \"u / I")).find("torque = nan"),
            std::string::npos);
}

TEST(RobotStart, FormulasThatAvoidTheirPolesAreTaken) {
  EXPECT_EQ(complaint_of(with("\"sin(angle)\"]", "\"where(rate == 0, 1, sin(rate) / rate)\"]")), "");
  EXPECT_EQ(complaint_of(with("unit = \"N m\"", "delay_s = 0.2\nlag_s = 0.05")), "");
  std::string text = with("width = 0.5", "width = 0.5\ncost = \"1 / time\"");
  text.replace(text.find("[define]"), 8, "[define]\ntime = \"3\"");
  EXPECT_EQ(complaint_of(text), "") << "the time of the file, which is not 0";
}

}  // namespace
}  // namespace rehearse::robot_file
