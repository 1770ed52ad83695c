#include "rehearse/mujoco/parameters.hpp"

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

using Apply = Target::Apply;

const Vector kAngleAndRate{{0.7, 3}}, kTorque{{0.4}};

/// The step of a pendulum of one parameter against the equation.
void expect_motion(const Target& target, double value, const PendulumNumbers& numbers, double tolerance = 1e-8) {
  ModelDescription model = pendulum_model();
  model.parameters = {{"p", "", value, {target}}};
  const Vector expected = by_equation(pendulum_equation(numbers), kAngleAndRate, kTorque);
  const Vector same = by_equation(pendulum_equation(), kAngleAndRate, kTorque);
  EXPECT_NEAR((by_model(model, kAngleAndRate, kTorque) - expected).norm(), 0, tolerance) << target.field;
  EXPECT_GT((expected - same).norm(), 1e-4) << target.field;
}

TEST(Parameters, EveryFieldOfAPendulumActsAsTheEquationSays) {
  expect_motion({"body", "arm", "mass"}, 1.5, {.mass = 1.5});
  expect_motion({"body", "arm", "inertia", 1}, 0.2, {.inertia = 0.2});
  expect_motion({"body", "arm", "ipos", 2, Apply::value, -1}, 0.7, {.centre = 0.7});
  expect_motion({"joint", "hinge", "damping"}, 0.3, {.damping = 0.3});
  expect_motion({"joint", "hinge", "armature"}, 0.2, {.armature = 0.2});
  expect_motion({"joint", "hinge", "stiffness"}, 2, {.stiffness = 2});
  expect_motion({"joint", "hinge", "frictionloss"}, 0.5, {.friction = 0.5}, 1e-6);
  expect_motion({"actuator", "motor", "gear", 0}, 3, {.gear = 3});
  expect_motion({"actuator", "motor", "gainprm", 0, Apply::scale}, 3, {.push = 0.8});
  expect_motion({"actuator", "motor", "biasprm", 0}, 0.6, {.push = 0.6});
  expect_motion({"option", "", "gravity", 2, Apply::value, -1}, 3.7, {.gravity = 3.7});
  expect_motion({"tendon", "cord", "stiffness"}, 2, {.stiffness = 2});
  expect_motion({"tendon", "cord", "damping"}, 0.3, {.damping = 0.3});
  expect_motion({"tendon", "cord", "frictionloss"}, 0.5, {.friction = 0.5}, 1e-6);
}

TEST(Parameters, ScalesMultiplyAndPowersSquare) {
  const Target twice{"body", "arm", "mass", -1, Apply::scale, 2};
  expect_motion(twice, 1.5, {.mass = 3});
  expect_motion({"body", "arm", "inertia", -1, Apply::scale, 1, 2}, 3, {.inertia = 0.72});
}

TEST(Parameters, OneMovesSeveralFieldsAndSeveralMoveOne) {
  ModelDescription model = pendulum_model();
  model.parameters = {
      {"m", "kg", 2, {{"body", "arm", "mass"}, {"body", "arm", "inertia", -1, Apply::scale}}},
      {"l",
       "m",
       0.8,
       {{"body", "arm", "ipos", 2, Apply::value, -0.5}, {"body", "arm", "inertia", -1, Apply::scale, 1, 2}}}};
  const PendulumNumbers numbers{.mass = 2, .inertia = 0.08 * 2 * 0.64, .centre = 0.4};
  EXPECT_NEAR(
      (by_model(model, kAngleAndRate, kTorque) - by_equation(pendulum_equation(numbers), kAngleAndRate, kTorque))
          .norm(),
      0, 1e-8);
}

TEST(Parameters, AFirstLinkMayBeLonger) {
  ModelDescription model = acrobot_model();
  model.parameters = {{"l1", "m", 0.8, {{"body", "lower", "pos", 2, Apply::value, -1}}}};
  const Vector x{{0.4, -1, 2, -3}};
  EXPECT_NEAR((by_model(model, x, kTorque) - by_equation(acrobot_equation(0.8), x, kTorque)).norm(), 0, 1e-8);
}

ModelDescription puck_model() {
  ModelDescription model;
  model.path = data_file("puck.xml");
  model.dt_s = kControlStep;
  for (const char* joint : {"along", "up", "turn"}) {
    model.states.push_back({joint, State::Kind::position, {{joint}}, 0});
    model.states.push_back({std::string("d") + joint, State::Kind::velocity, {{joint}}, 0});
  }
  return model;
}

TEST(Parameters, AGeomsFrictionSlowsWhatSlides) {
  ModelDescription model = puck_model();
  model.parameters = {{"mu", "", 0.5, {{"geom", "puck", "friction", 0}}}};
  const auto loss = [&](double mu) {
    model.parameters[0].value = mu;
    const Vector x{{0, 2, 0, 0, 0, 0}};
    return 2 - by_model(model, x, Vector())(1);
  };
  EXPECT_NEAR(loss(0.5), 0.5 * 9.81 * kControlStep, 0.05);
  EXPECT_NEAR(loss(0.2) / loss(0.5), 0.4, 0.05);
}

TEST(Parameters, AGeomsSizeAndPlaceSayWhereItTouches) {
  ModelDescription model = puck_model();
  const Vector falling{{0, 0, 0.1, 0, 0, 0}};
  const double free = -9.81 * kControlStep;
  model.parameters = {{"size", "m", 0.1, {{"geom", "puck", "size", 2}}}};
  EXPECT_NEAR(by_model(model, falling, Vector())(3), free, 1e-9);
  model.parameters[0].value = 0.25;
  EXPECT_GT(by_model(model, falling, Vector())(3), 0);
  model.parameters = {{"down", "m", 0.15, {{"geom", "puck", "pos", 2, Apply::value, -1}}}};
  EXPECT_GT(by_model(model, falling, Vector())(3), 0);
}

/// MuJoCo takes shortcuts for bodies whose centre of mass is their origin.
TEST(Parameters, ACentreOfMassMayLeaveTheOrigin) {
  ModelDescription moved = puck_model();
  moved.parameters = {{"c", "m", 0.05, {{"body", "puck", "ipos", 0}}}};
  const Vector tossed{{0, 1, 5, 2, 0.3, 4}};
  const Vector after = by_model(moved, tossed, Vector());
  // In the air the centre of mass flies freely and the turn stays.
  const double angle = 0.3 + 4 * kControlStep;
  EXPECT_NEAR(after(4), angle, 1e-4);
  EXPECT_NEAR(after(0) + 0.05 * std::cos(angle), 0.05 * std::cos(0.3) + (1 - 0.05 * 4 * std::sin(0.3)) * kControlStep,
              2e-4);
  EXPECT_GT((after - by_model(puck_model(), tossed, Vector())).norm(), 1e-3);
}

TEST(Parameters, WrongOnesAreAllNamed) {
  ModelDescription model = pendulum_model();
  model.parameters = {{"a", "", 1, {}},
                      {"b", "", 1, {{"body", "arm", "mass", -1, Apply::value, NAN}, {"body", "arm", "mas"}}},
                      {"c", "", 1, {{"body", "arm", "mass"}}},
                      {"c", "", 1, {{"body", "arm", "inertia"}}}};
  EXPECT_EQ(complaint_of([&] { compile(model); }),
            "parameter 'a' has no targets, must have one\n"
            "parameter 'b', body 'arm' mass: factor = nan, must be finite\n"
            "parameter 'b': body has no field 'mas', did you mean 'mass'? (known: inertia, ipos, mass, pos)\n"
            "parameter 'c' stands twice\n"
            "'b' and 'c' both set the mass of the same body, must be one");
  const Target twice{"body", "arm", "mass", -1, Apply::scale};
  model.parameters = {{"d", "", 1, {twice, twice}}};
  EXPECT_EQ(complaint_of([&] { compile(model); }), "'d' scales the mass of the same body twice, must be once");
  model.parameters = {{"d", "", 1, {twice, {"body", "arm", "mass"}}}};
  EXPECT_EQ(complaint_of([&] { compile(model); }), "'d' sets and scales the mass of the same body, must do one");
}

}  // namespace
}  // namespace rehearse::mujoco
