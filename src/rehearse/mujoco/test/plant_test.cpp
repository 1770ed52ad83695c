#include "rehearse/mujoco/plant.hpp"

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"
#include "rehearse/testing/check_plant.hpp"

namespace rehearse::mujoco {
namespace {

PlantOptions acrobot_plant(double noise) {
  return {.model = compile(acrobot_model()),
          .phi = Vector(),
          .around = {Vector{{3, 3, 0, 0}}, Vector::Constant(4, 0.1), Vector::Constant(4, noise)}};
}

TEST(ModelPlant, KeepsTheLaws) {
  Task task;
  task.states = {{"a1"}, {"a2"}, {"da1"}, {"da2"}};
  task.actions = {{"u", "N m", {-3, 3}}};
  task.horizon = 10;
  EXPECT_EQ(testing::check_plant([] { return make_plant(acrobot_plant(0.01)); }, task), std::vector<std::string>());
}

TEST(ModelPlant, DrawsAndMovesAsAnEquationDoes) {
  const auto plant = make_plant(acrobot_plant(0.01));
  const PlantOptions options = acrobot_plant(0.01);
  const auto other = system::make_ode_plant(
      {.ode = acrobot_equation(), .phi = Vector(), .dt_s = kControlStep, .around = options.around});
  Rng rng({.seed = 5}), same_rng({.seed = 5});
  EXPECT_NEAR((plant->reset(rng) - other->reset(same_rng)).norm(), 0, 1e-12);
  for (int t = 0; t < 10; ++t) {
    const Vector u = Vector::Constant(1, t % 3 - 1);
    EXPECT_NEAR((plant->step(u) - other->step(u)).norm(), 0, 1e-6);
    EXPECT_NEAR((plant->truth() - other->truth()).norm(), 0, 1e-6);
  }
}

TEST(ModelPlant, ReadOnlyStatesFollowFromTheStart) {
  ModelDescription seen = pendulum_model();
  seen.states.push_back({"tip x", State::Kind::site, {{"tip"}}, 0});
  const auto plant =
      make_plant({.model = compile(seen), .phi = Vector(), .around = {Vector{{0.5, 0, 9}}, Vector::Zero(3), Vector()}});
  Rng rng({.seed = 5});
  EXPECT_NEAR(plant->reset(rng)(2), std::sin(0.5), 1e-12);
  const Vector x = plant->step(Vector{{1}});
  EXPECT_NEAR(x(2), std::sin(x(0)), 1e-12);
}

TEST(ModelPlant, ThrowsWhereItDiverges) {
  const auto plant = make_plant(acrobot_plant(0));
  Rng rng({.seed = 5});
  EXPECT_THROW(plant->step(Vector{{0}}), std::logic_error);
  plant->reset(rng);
  try {
    plant->step(Vector{{NAN}});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "MuJoCo's simulation of acrobot.xml diverged") << "the folder may be a temporary one";
  }
  EXPECT_THROW(plant->step(Vector{{1, 2}}), InvalidInput);
  plant->reset(rng);
  EXPECT_TRUE(plant->step(Vector{{1}}).allFinite());
}

TEST(ModelPlant, WrongSizesAreAllNamed) {
  EXPECT_EQ(complaint_of([] {
              make_plant({.model = compile(acrobot_model()),
                          .phi = Vector{{1}},
                          .around = {Vector::Zero(3), Vector::Zero(2), Vector::Zero(1)}});
            }),
            "start_mean has 3 entries, must have 4\n"
            "start_std has 2 entries, must have the 3 of start_mean\n"
            "measurement_std has 1 entries, must have none or the 3 of start_mean\n"
            "phi has 1 entries, must have 0");
}

}  // namespace
}  // namespace rehearse::mujoco
