#include "rehearse/mujoco/simulator.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"
#include "rehearse/mujoco/test/robots.hpp"
#include "rehearse/testing/check_simulator.hpp"
#include "rehearse/testing/compare.hpp"

namespace rehearse::mujoco {
namespace {

Matrix random_rows(Index rows, Index columns, double spread) {
  Rng rng({.seed = 3});
  Matrix numbers(rows, columns);
  for (double& number : numbers.reshaped()) number = rng.uniform(-spread, spread);
  return numbers;
}

/// The acrobot with the lower link's mass as its parameter.
ModelDescription heavy_acrobot() {
  ModelDescription model = acrobot_model();
  model.parameters = {{"m2", "kg", 0.8, {{"body", "lower", "mass"}}}};
  return model;
}

void expect_equation(const ModelDescription& model, const system::Ode& equation) {
  const Index dx = static_cast<Index>(model.states.size());
  const Matrix X = random_rows(10, dx, 3), U = random_rows(10, 1, 2);
  for (Index i = 0; i < X.rows(); ++i) {
    const Vector x = X.row(i), u = U.row(i);
    EXPECT_NEAR((by_model(model, x, u) - by_equation(equation, x, u)).norm(), 0, 2e-8) << i;
  }
}

TEST(ModelSimulator, AgreesWithTheEquationOfAPendulum) { expect_equation(pendulum_model(), pendulum_equation()); }

TEST(ModelSimulator, AgreesWithTheEquationOfAnAcrobotInAbsoluteAngles) {
  expect_equation(acrobot_model(), acrobot_equation());
}

TEST(ModelSimulator, AUrdfIsPushedAtItsJoints) {
  ModelDescription model = acrobot_model("acrobot.urdf");
  model.actions = {{"elbow", Action::Kind::joint}};
  model.substeps = 500;
  model.parameters = {{"g", "m/s²", 9.82, {{"option", "", "gravity", 2, Target::Apply::value, -1}}}};
  const Vector x{{0.4, -1, 2, -3}}, u{{0.5}};
  EXPECT_NEAR((by_model(model, x, u) - by_equation(acrobot_equation(), x, u)).norm(), 0, 2e-3);  // Euler's method
}

TEST(ModelSimulator, KeepsTheLaws) {
  const Matrix X = random_rows(12, 4, 3), U = random_rows(12, 1, 2);
  const auto simulator = simulator_of(heavy_acrobot());
  EXPECT_EQ(testing::check_simulator(*simulator, X, U, Vector{{0.8}}), std::vector<std::string>());
  ModelDescription seen = pendulum_model();
  seen.states.push_back({"tip", State::Kind::site, {{"tip", 1, 2}}, 0});
  seen.states.push_back({"speed", State::Kind::sensor, {{"speed"}}, 0});
  EXPECT_EQ(testing::check_simulator(*simulator_of(seen), X, U, Vector()), std::vector<std::string>());
}

TEST(ModelSimulator, ContactsKeepTheLawsToo) {
  ModelDescription model;
  model.path = data_file("puck.xml");
  model.dt_s = kControlStep;
  for (const char* joint : {"along", "up", "turn"})
    model.states.push_back({joint, State::Kind::position, {{joint}}, 0});
  model.actions = {{"along", Action::Kind::joint}};
  const Matrix X = 0.01 * random_rows(8, 3, 1), U = random_rows(8, 1, 1);
  EXPECT_EQ(testing::check_simulator(*simulator_of(model), X, U, Vector()), std::vector<std::string>());
}

TEST(ModelSimulator, ParametersLeaveNoTrace) {
  const Matrix X = random_rows(5, 4, 3), U = random_rows(5, 1, 2);
  const auto change = [&](const system::Simulator& simulator, double mass) {
    Matrix dX(5, 4);
    simulator.change(X, U, Vector{{mass}}, dX);
    return dX;
  };
  const auto make = [] { return simulator_of(heavy_acrobot()); };
  const auto simulator = make();
  const Matrix first = change(*simulator, 1.1);
  EXPECT_FALSE(testing::same(change(*simulator, 0.4), first));
  EXPECT_TRUE(testing::same(change(*simulator, 1.1), first));
  EXPECT_TRUE(testing::same(change(*make(), 1.1), first));
}

TEST(ModelSimulator, PhiHasTheOrderOfItsSpace) {
  ModelDescription model = pendulum_model();
  model.parameters = {{"m", "kg", 2, {{"body", "arm", "mass"}}}, {"b", "", 0.3, {{"joint", "hinge", "damping"}}}};
  const ParameterSpace turned({Parameter::fixed("b", 0.3), Parameter::fixed("m", 2)});
  const Vector x{{1, 2}}, u{{1}};
  Matrix dX(1, 2);
  make_simulator(compile(model), turned)->change(x.transpose(), u.transpose(), turned.values(), dX);
  EXPECT_TRUE(testing::same(x + dX.transpose(), by_model(model, x, u)));
}

TEST(ModelSimulator, RowsThatDivergeAreNan) {
  ModelDescription model = pendulum_model();
  model.parameters = {{"k", "N m/rad", 1, {{"joint", "hinge", "stiffness"}}}};
  const Matrix X{{0, 0}, {1, 0}, {0, 0}};
  Matrix dX(3, 2);
  simulator_of(model)->change(X, Matrix::Zero(3, 1), Vector{{1e9}}, dX);
  EXPECT_TRUE(dX.row(0).isZero() && dX.row(2).isZero());
  EXPECT_TRUE(dX.row(1).array().isNaN().all());
}

TEST(ModelSimulator, AnErrorOfTheEngineIsARowOfNan) {
  ModelDescription model;
  model.path = data_file("cramped.xml");
  model.dt_s = 0.002;
  model.states = {{"z", State::Kind::position, {{"up"}}, 0}, {"dz", State::Kind::velocity, {{"up"}}, 0}};
  const auto simulator = simulator_of(model);
  const Matrix X{{0, 0}, {-0.95, 0}, {0, 0}};
  Matrix dX(3, 2);
  simulator->change(X, Matrix(3, 0), Vector(), dX);
  EXPECT_TRUE(dX.row(1).array().isNaN().all());
  EXPECT_LT(dX(0, 1), 0);
  EXPECT_TRUE(testing::same(dX.row(0), dX.row(2)));
}

TEST(ModelSimulator, RefusesValuesThatMakeNoModel) {
  const auto simulator = simulator_of(heavy_acrobot());
  Matrix dX(1, 4);
  EXPECT_THROW(simulator->change(Matrix::Zero(1, 4), Matrix::Zero(1, 1), Vector{{NAN}}, dX), InvalidInput);
  EXPECT_THROW(simulator->change(Matrix::Zero(1, 4), Matrix::Zero(1, 2), Vector{{1}}, dX), InvalidInput);
  system::change_contained(*simulator, Matrix::Zero(1, 4), Matrix::Zero(1, 1), Vector{{-50}}, dX);
  simulator->change(Matrix::Zero(1, 4), Matrix::Zero(1, 1), Vector{{1}}, dX);
  EXPECT_TRUE(dX.isZero());
}

TEST(ModelSimulator, WhatNoStateGivesIsThatOfTheKeyframe) {
  ModelDescription model = pendulum_model();
  model.keyframe = "up";
  model.states = {{"speed", State::Kind::sensor, {{"speed"}}, 0}};
  EXPECT_EQ(warnings_of(compile(model), {{-1, 1}}, Vector::Zero(1)).unseen,
            (std::vector<std::string>{"position of joint 'hinge'", "velocity of joint 'hinge'"}));
  const Vector up{{3, 0.5}}, u{{1}};
  EXPECT_NEAR(by_model(model, Vector::Zero(1), u)(0), by_equation(pendulum_equation(), up, u)(1), 1e-8);
  EXPECT_TRUE(warnings_of(compile(pendulum_model()), {{-1, 1}}, Vector::Zero(2)).unseen.empty());
}

TEST(ModelSimulator, NamesWhatDoesNotFitTheTask) {
  ModelDescription model = pendulum_model();
  EXPECT_TRUE(warnings_of(compile(model), {{-100, 100}}, Vector{{10, 0}}).misfits.empty())
      << "neither motor nor hinge has a range";
  model.path = data_file("narrow.xml");
  EXPECT_TRUE(warnings_of(compile(model), {{-2, 1}}, Vector{{-0.5, 9}}).misfits.empty());
  EXPECT_EQ(warnings_of(compile(model), {{-2, 2.5}}, Vector{{1, 0}}).misfits,
            (std::vector<std::string>{
                "actuator 'motor' takes -2 to 2, the action has bounds of -2 and 2.5: MuJoCo cuts what is beyond",
                "joint 'hinge' starts at 1, outside of its range of -0.5236 to 0.5236 (angles are in rad)"}));
}

TEST(ModelSimulator, NamesParametersThatAreMissingOrUnknown) {
  const ParameterSpace other({Parameter::fixed("m3", 1)});
  EXPECT_EQ(complaint_of([&] { make_simulator(compile(heavy_acrobot()), other); }),
            "parameter 'm2' of the model is missing\n"
            "unknown parameter 'm3', did you mean 'm2'? (known: m2)");
  EXPECT_EQ(complaint_of([&] { make_simulator(compile(acrobot_model()), other); }),
            "unknown parameter 'm3': the model has none");
}

}  // namespace
}  // namespace rehearse::mujoco
