// Functions of the program in the place of formulas, dynamics and the plant.
#include "rehearse/robot_file/functions.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/robot_file/test/example.hpp"

namespace rehearse::robot_file {
namespace {

constexpr const char* kFile = R"toml(format = 1
name = "pushed"
dt_s = 0.1
horizon = 5
ended = "@far"

[[state]]
name = "x"

[[action]]
name = "u"
bounds = [-2, 2]

[reward]
formula = "@near"

[success]
when = "@there"

[[limit]]
name = "gentle"
keep = "@gentle"

[dynamics.push]
function = "push"
parameters = { gain = 1 }

[plant]
function = "robot"

[prior.weak]
parameters.gain = 0.5
tune.gain = [0.1, 2]
)toml";

/// Its episodes end by themselves in the third step.
class Robot3 final : public system::Plant {
 public:
  Vector reset(Rng&) override { return Vector{{x_ = static_cast<double>(steps_ = 0)}}; }
  Vector step(const Vector& u) override { return ++steps_, Vector{{x_ += u(0)}}; }
  bool ended() const override { return steps_ == 3; }

 private:
  double x_ = 0;
  int steps_ = 0;
};

Functions functions() {
  Functions functions;
  functions.rows_at_once = 100;
  functions.of_steps["near"] = [](const auto&, const auto&, const auto& X_next, VectorView r) {
    r = (-X_next.col(0).array().square()).exp();
  };
  functions.limits["gentle"] = [](const Steps& steps, VectorView holds) {
    holds = (steps.U.col(0).array().abs() < 1.5).cast<double>();
  };
  functions.of_states["far"] = each_state([](const ConstVectorView& x) { return x(0) > 3; });
  functions.of_states["there"] = each_state([](const ConstVectorView& x) { return x(0) > 1; });
  functions.dynamics["push"] = [](const auto&, const auto& U, const Vector& phi, MatrixView dX) { dX = phi(0) * U; };
  functions.plants["robot"] = [] { return std::make_unique<Robot3>(); };
  return functions;
}

std::string complaint(const std::string& text, const Functions& known) {
  try {
    builder(text, "pushed.toml", example::no_files, known);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(RobotFunctions, StandWhereTheFileNamesThem) {
  const scenario::Scenario scenario = builder(kFile, "pushed.toml", example::no_files, functions())->build();
  const Task& task = scenario.task;
  Vector value(1);
  task.reward(Matrix{{0.0}}, Matrix{{1.0}}, Matrix{{0.5}}, value);
  EXPECT_DOUBLE_EQ(value(0), std::exp(-0.25));
  EXPECT_TRUE(holds(task.ended, Vector{{4}}));
  EXPECT_FALSE(holds(task.ended, Vector{{2}}));
  task.limits.front().holds({Matrix{{0.0}}, Matrix{{1.8}}, Matrix{{0.5}}, Matrix{{0.0}}}, value);
  EXPECT_EQ(value(0), 0);
  EXPECT_EQ(task.rows_at_once, 100);
  const scenario::NamedPrior& prior = scenario.priors.front();
  EXPECT_EQ(prior.simulator->rows_at_once(), 100);
  Matrix change(1, 1);
  prior.simulator->change(Matrix{{0.0}}, Matrix{{1.0}}, prior.parameters.values(), change);
  EXPECT_EQ(change(0, 0), 0.5);
}

TEST(RobotFunctions, APlantsAngleMayStayWithinOneTurn) {
  Functions known = functions();
  class Wheel final : public system::Plant {
   public:
    Vector reset(Rng&) override { return Vector{{3}}; }
    Vector step(const Vector&) override { return Vector{{-3}}; }
  };
  known.plants["robot"] = [] { return std::make_unique<Wheel>(); };
  std::string text = kFile;
  text.insert(text.find("name = \"x\""), "angle = true\n");
  const auto plant = builder(text, "pushed.toml", example::no_files, known)->build().make_plant();
  Rng rng({.seed = 1});
  EXPECT_EQ(plant->reset(rng), Vector{{3}});
  EXPECT_DOUBLE_EQ(plant->step(Vector{{0}})(0), 2 * std::numbers::pi - 3);
}

TEST(RobotFunctions, APlantIsWhatTheProgramMakes) {
  const scenario::Scenario scenario = builder(kFile, "pushed.toml", example::no_files, functions())->build();
  const auto plant = scenario.make_plant();
  Rng rng({.seed = 1});
  EXPECT_EQ(plant->reset(rng), Vector{{0}});
  EXPECT_EQ(plant->step(Vector{{0.5}}), Vector{{0.5}});
  EXPECT_FALSE(plant->ended());
  EXPECT_EQ(scenario.oracle, nullptr);
}

TEST(RobotFunctions, ADynamicsMayPlayTheRobot) {
  std::string text = kFile;
  text.replace(text.find("function = \"robot\""), 18, "dynamics = \"push\" ");
  const scenario::Scenario scenario = builder(text, "pushed.toml", example::no_files, functions())->build();
  const auto plant = scenario.make_plant();
  Rng rng({.seed = 1});
  plant->reset(rng);
  EXPECT_EQ(plant->step(Vector{{0.5}}), Vector{{0.5}});
  EXPECT_NE(scenario.oracle, nullptr);
}

TEST(RobotFunctions, HaveNoSubsteps) {
  const auto violations = [](scenario::ScenarioBuilder& of) {
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { of.fields(v); }, "substeps", "40"));
    return field_violations([&](FieldVisitor& v) { of.fields(v); });
  };
  EXPECT_EQ(violations(*builder(kFile, "pushed.toml", example::no_files, functions())),
            std::vector<std::string>{
                "substeps: no dynamics are equations; a model of MuJoCo has substeps in the robot's file"});
  EXPECT_TRUE(violations(*builder(example::kSwing, "swing.toml", example::no_files)).empty());
}

TEST(RobotFunctions, ThoseOfAnotherProgramAreMissed) {
  const std::string lines = complaint(kFile, {});
  EXPECT_NE(lines.find("'robot' is a function"), std::string::npos) << lines;
  EXPECT_NE(
      lines.find("line 24: 'push' is a function of the program that wrote this file, and no file keeps functions"),
      std::string::npos)
      << lines;
  Functions half = functions();
  half.of_steps.erase("near");
  EXPECT_NE(complaint(kFile, half).find("line 15: 'near' is a function"), std::string::npos) << complaint(kFile, half);
}

TEST(RobotFunctions, WhoOnlyLooksDoesWithout) {
  const scenario::Scenario scenario = builder(kFile, "pushed.toml", example::no_files, {.only_look = true})->build();
  EXPECT_EQ(scenario.task.states.front().name, "x");
  Vector value(1);
  EXPECT_THROW(scenario.task.reward(Matrix{{0.0}}, Matrix{{1.0}}, Matrix{{0.5}}, value), InvalidInput);
  EXPECT_THROW(holds(scenario.task.ended, Vector{{4}}), InvalidInput);
  EXPECT_THROW(scenario.make_plant(), InvalidInput);
}

TEST(RobotFunctions, APlantThatMeasuresHasNoOtherNoise) {
  std::string text = kFile;
  text.insert(text.find("function = \"robot\""), "measurement_noise = 0.1\n");
  EXPECT_NE(complaint(text, functions()).find("measures by itself"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::robot_file
