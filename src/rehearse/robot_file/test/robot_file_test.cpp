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
  EXPECT_TRUE(made->summary().ends_with("solved: height > 0.9 for the last 0.2 s")) << made->summary();
  const scenario::Scenario scenario = made->build();
  EXPECT_EQ(scenario.task.violations(), std::vector<std::string>{});
  EXPECT_EQ(scenario.policy->actions(), 1);
  ASSERT_EQ(scenario.priors.size(), 1u);
  EXPECT_TRUE(scenario.priors[0].parameters.has_tunable());
}

TEST(RobotFile, SaysWhatItStatesOfThePolicy) {
  const auto stated = [](const std::string& text) { return builder(text, "swing.toml", example::no_files)->stated(); };
  EXPECT_EQ(stated(std::string(kSwing)), std::vector<std::string>{});
  EXPECT_EQ(stated(example::with("[plant]", "[policy]\npolicy = \"linear\"\nhidden = 5\n[plant]")),
            (std::vector<std::string>{"hidden", "policy"}));
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

TEST(RobotFile, StatesAreMeasuredWithNoiseOfTheirOwn) {
  const auto made =
      builder(example::with("[plant]", "[plant]\nmeasurement_noise.angle = 0.1"), "swing.toml", example::no_files);
  const Fields fields = [&](FieldVisitor& v) { made->fields(v); };
  EXPECT_FALSE(set_field(fields, "measurement_noise", "0.1"));
  EXPECT_TRUE(set_field(fields, "measurement_noise.angle", "0.2"));
  auto plant = made->build().make_plant();
  Rng rng({.seed = 1});
  const Vector measured = plant->reset(rng), exact = plant->truth();
  EXPECT_EQ(measured[0], exact[0]);
  EXPECT_NE(measured[1], exact[1]);
  EXPECT_NEAR(measured[1], exact[1], 1);
}

const std::string kDelayed = example::with(
    "bounds = [-2, 2]", "bounds = [-2, 2]\nmax_rate = 30\nfilter_s = 0.02\ndelay_s = 0.2\nlag_s = 0.05\nremember = 3");

TEST(RobotFile, ActuatorsAddWhatTheyRemember) {
  const scenario::Scenario scenario = builder(kDelayed, "swing.toml", example::no_files)->build();
  EXPECT_EQ(scenario.task.state_names(),
            (std::vector<std::string>{"rate", "angle", "u_last", "u_last2", "u_last3", "u_reached"}));
  EXPECT_EQ(scenario.task.violations(), std::vector<std::string>{});
  EXPECT_EQ(scenario.task.memory, 4);
  Matrix change(1, 6), own(1, 2);
  const Matrix X{{0.1, 3.0, 0.5, -0.5, 0.7, 0.2}};
  const double stays = std::exp(-0.1 / 0.05), moving = -0.5 + (1 - stays) * 0.5 * (0.2 - -0.5);
  scenario.oracle->change(X, Matrix{{1.0}}, scenario.oracle->parameters().values(), change);
  scenario.oracle->behind_actuators()->change(Matrix{{0.1, 3.0}}, Matrix{{moving}},
                                              scenario.oracle->parameters().values(), own);
  EXPECT_TRUE(change.leftCols(2).isApprox(own, 1e-14));
  EXPECT_TRUE((X + change).rightCols(4).isApprox(Matrix{{1, 0.5, -0.5, -0.5 + stays * 0.7}}, 1e-14));
}

TEST(RobotFile, PlantsHaveTheDelaysOfTheirActions) {
  const scenario::Scenario scenario = builder(kDelayed, "swing.toml", example::no_files)->build();
  EXPECT_EQ(testing::check_plant(scenario.make_plant, scenario.task), std::vector<std::string>{});
  auto plant = scenario.make_plant();
  Rng rng({.seed = 1});
  Vector x = plant->reset(rng);
  Matrix change(1, 6);
  for (const double u : {0.5, -1.0, 2.0, 0.3, 0.1}) {
    scenario.oracle->change(x.transpose(), Matrix{{u}}, scenario.oracle->parameters().values(), change);
    const Vector next = plant->step(Vector{{u}});
    EXPECT_LT((x + change.row(0).transpose() - next).norm(), 1e-6);
    x = next;
  }
}

TEST(RobotFile, SaysWhatAPlantHasAndItsOracleHasNot) {
  const auto lacks = [](const std::string& key, const std::string& value) {
    const auto made = builder(kDelayed, "swing.toml", example::no_files);
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { made->fields(v); }, key, value));
    return made->build().oracle_lacks;
  };
  EXPECT_EQ(lacks("plant.delay_s.u", "0.2"), std::vector<std::string>{});
  EXPECT_EQ(lacks("plant.delay_s.u", "0.3"),
            std::vector<std::string>{"u: the plant has delay_s = 0.3 and lag_s = 0.05, its oracle those of the action, "
                                     "as all models: 0.2 and 0.05"});
}

TEST(RobotFile, SaysWhichParametersOfAPriorCannotBe) {
  const auto lacks = [](const std::string& bounds) {
    std::string text = example::with("m = 1,", "m = { value = 1, unit = \"kg\" },");
    const std::string given = "tune.m = [0.5, 2]";
    text.replace(text.find(given), given.size(), "tune.m = " + bounds);
    return builder(text, "swing.toml", example::no_files)->build().priors.front().lacks;
  };
  EXPECT_EQ(lacks("[0, 2]"), std::vector<std::string>{}) << "a load may be 0";
  EXPECT_EQ(lacks("[-1, 2]"), std::vector<std::string>{"m is learned in [-1, 2] kg: no mass is negative"});
  EXPECT_EQ(lacks("[1.1, 2]"),
            std::vector<std::string>{"m is 1 in the plant, outside of [1.1, 2], in which it is learned"});
}

/// The change of the rate in the first step of the plant under the largest action.
double first_push(const std::string& text, const std::string& delay_s = "") {
  const auto made = builder(text, "swing.toml", example::no_files);
  if (!delay_s.empty()) {
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { made->fields(v); }, "plant.delay_s.u", delay_s));
  }
  const auto plant = made->build().make_plant(), still = made->build().make_plant();
  Rng rng({.seed = 1}), same({.seed = 1});
  plant->reset(rng), still->reset(same);
  return plant->step(Vector{{2.0}})(0) - still->step(Vector{{0.0}})(0);
}

TEST(RobotFile, PlantsMayHaveOtherDelaysThanTheirModels) {
  const double at_once = first_push(kSwing);
  EXPECT_GT(at_once, 0.5);
  EXPECT_EQ(first_push(kDelayed), 0);
  const std::size_t at = kDelayed.find("[plant]") + 8;
  const auto with_plant = [&](const std::string& keys) { return kDelayed.substr(0, at) + keys + kDelayed.substr(at); };
  EXPECT_NEAR(first_push(with_plant("delay_s = { u = 0 }\nlag_s = { u = 0 }\n")), at_once, 1e-9);
  EXPECT_NEAR(first_push(with_plant("lag_s = { u = 0 }\n"), "0.05"), at_once / 2, 0.02 * at_once);
}

TEST(RobotFile, FormulasMayUseWhatIsRemembered) {
  const std::string text = kDelayed + "[[limit]]\nkeep = \"abs(u_last - u_last2) < 1\"\n";
  const Task task = builder(text, "swing.toml", example::no_files)->build().task;
  const Matrix X = Matrix::Zero(2, 6), U = Matrix::Zero(2, 1);
  const Matrix reached{{0, 0, 1.0, 0.5, 0, 0}, {0, 0, 1.0, -0.5, 0, 0}};
  Vector kept(2);
  task.limits[0].holds({X, U, reached, U}, kept);
  EXPECT_EQ(kept, (Vector{{1, 0}}));
}

TEST(RobotFile, WithoutActuatorsHasNoOptionsOfThem) {
  const auto made = builder(kSwing, "swing.toml", example::no_files);
  EXPECT_FALSE(set_field([&](FieldVisitor& v) { made->fields(v); }, "plant.delay_s.u", "0.1"));
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
