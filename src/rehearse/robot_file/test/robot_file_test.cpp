#include "rehearse/robot_file/robot_file.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/testing/check_plant.hpp"
#include "rehearse/testing/check_simulator.hpp"

namespace rehearse::robot_file {
namespace {

using example::kSwing;

TEST(RobotFile, MakesAScenarioWithEverythingOfTheFile) {
  const auto made = builder(kSwing, "swing.toml", example::no_files);
  EXPECT_EQ(made->name(), "swing");
  EXPECT_EQ(made->prior_names(), std::vector<std::string>{"heavy"});
  const scenario::Scenario scenario = made->build();
  EXPECT_EQ(scenario.task.violations(), std::vector<std::string>{});
  EXPECT_EQ(scenario.policy->actions(), 1);
  ASSERT_EQ(scenario.priors.size(), 1u);
  EXPECT_TRUE(scenario.priors[0].parameters.has_tunable());
}

// u + m g l sin θ over m l².
TEST(RobotFile, PlantAndPriorsFollowTheEquation) {
  const scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  Matrix change(1, 2);
  scenario.oracle->change(Matrix{{0.0, 3.0}}, Matrix{{1.0}}, scenario.oracle->parameters().values(), change);
  const double rate = (1 + 9.81 * 0.5 * std::sin(3)) / 0.25;
  EXPECT_NEAR(change(0, 0), 0.1 * rate, 0.1 * std::abs(change(0, 0)));
  Matrix heavy(1, 2);
  scenario.priors[0].simulator->change(Matrix{{0.0, 3.0}}, Matrix{{1.0}}, scenario.priors[0].parameters.values(),
                                       heavy);
  EXPECT_LT(std::abs(heavy(0, 0)), std::abs(change(0, 0)));
  auto plant = scenario.make_plant();
  Rng rng({.seed = 1});
  const Vector before = plant->reset(rng), after = plant->step(Vector{{1.0}});
  scenario.oracle->change(before.transpose(), Matrix{{1.0}}, scenario.oracle->parameters().values(), change);
  EXPECT_LT((before + change.row(0).transpose() - after).norm(), 1e-7);
}

TEST(RobotFile, OptionsSetThePlant) {
  const auto made = builder(kSwing, "swing.toml", example::no_files);
  const Fields fields = [&](FieldVisitor& v) { made->fields(v); };
  EXPECT_TRUE(set_field(fields, "plant.m", "2"));
  EXPECT_TRUE(set_field(fields, "measurement_noise", "0.1"));
  EXPECT_TRUE(set_field(fields, "hidden", "3"));
  EXPECT_FALSE(set_field(fields, "plant.mass", "2"));
  EXPECT_EQ(made->build().oracle->parameters().values(), (Vector{{2, 0.5}}));
}

TEST(RobotFile, KeepsTheLaws) {
  const scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  const Matrix X = Matrix::Random(70, 2), U = Matrix::Random(70, 1);
  EXPECT_EQ(testing::check_simulator(*scenario.priors[0].simulator, X, U, scenario.priors[0].parameters.values()),
            std::vector<std::string>{});
  EXPECT_EQ(testing::check_plant(scenario.make_plant, scenario.task), std::vector<std::string>{});
}

}  // namespace
}  // namespace rehearse::robot_file
