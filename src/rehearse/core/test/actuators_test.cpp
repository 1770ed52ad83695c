#include "rehearse/core/actuators.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/task.hpp"

namespace rehearse {
namespace {

constexpr double kDt = 0.05;

Actuators of_one(const Actuation& actuation, Interval bounds = {-2, 2}) {
  return {{{.name = "u", .unit = "N", .bounds = bounds, .actuation = actuation}}, kDt, 0};
}

struct Followed {
  Vector commands, moving;
  Matrix memory;  // before each step, and after the last
};

/// Commands and moving actions for the actions that a policy wants, step by step.
Followed follow(const Actuators& actuators, const Vector& wanted) {
  Followed followed{Vector(wanted.size()), Vector(wanted.size()), Matrix(wanted.size() + 1, actuators.memory())};
  Matrix X = actuators.start().transpose(), U(1, 1), E(1, 1);
  followed.memory.row(0) = X;
  for (Index t = 0; t < wanted.size(); ++t) {
    U(0, 0) = wanted(t);
    actuators.command(X, U);
    actuators.moving(X, U, E);
    Matrix next(1, actuators.states());
    actuators.remember(X, U, next);
    X = next;
    followed.commands(t) = U(0, 0), followed.moving(t) = E(0, 0);
    followed.memory.row(t + 1) = X;
  }
  return followed;
}

TEST(Actuators, OfNothingRememberNothing) {
  const Actuators none = of_one({});
  EXPECT_EQ(none.memory(), 0);
  EXPECT_FALSE(none.changes_commands());
  const Vector wanted{{1, -2, 0.3}};
  const Followed followed = follow(none, wanted);
  EXPECT_EQ(followed.commands, wanted);
  EXPECT_EQ(followed.moving, wanted);
}

TEST(Actuators, LimitTheRate) {
  const Actuators actuators = of_one({.max_rate = 10});  // 0.5 a step
  const Followed followed = follow(actuators, Vector{{2, 2, 2, 2, 2, 1.75, -2, -2}});
  EXPECT_TRUE(followed.commands.isApprox(Vector{{0.5, 1, 1.5, 2, 2, 1.75, 1.25, 0.75}}, 1e-15));
  EXPECT_EQ(followed.commands(5), 1.75) << "what is near enough is the command to the bit";
  EXPECT_EQ(followed.moving, followed.commands);
}

TEST(Actuators, FilterAsALowPassDoes) {
  constexpr double kFilter = 0.12;
  const Followed followed = follow(of_one({.filter_s = kFilter}), Vector::Constant(20, 1.5));
  for (Index t = 0; t < 20; ++t)
    EXPECT_NEAR(followed.commands(t), 1.5 * (1 - std::exp(-kDt * static_cast<double>(t + 1) / kFilter)), 1e-14);
}

TEST(Actuators, DelayByWholeSteps) {
  const Actuators actuators = of_one({.delay_s = 2 * kDt});
  EXPECT_EQ(actuators.memory(), 2);
  const Vector wanted{{1, -1, 0.5, 2, -2}};
  const Followed followed = follow(actuators, wanted);
  EXPECT_EQ(followed.commands, wanted);
  EXPECT_EQ(followed.moving, (Vector{{0, 0, 1, -1, 0.5}}));
  EXPECT_EQ(followed.memory.row(5), (Eigen::RowVectorXd(2) << -2, 2).finished());
}

TEST(Actuators, DelayByPartsOfAStepIsTheMeanOfWhatArrives) {
  const Actuators actuators = of_one({.delay_s = 1.25 * kDt});
  EXPECT_EQ(actuators.memory(), 2);
  const Followed followed = follow(actuators, Vector{{1, -1, 2, 0}});
  EXPECT_TRUE(followed.moving.isApprox(Vector{{0, 0.75, -0.5, 1.25}}, 1e-12));
}

TEST(Actuators, DelaysThatAreDecimalFractionsAreWholeSteps) {
  for (int steps = 1; steps <= 20; ++steps) {
    const Actuators actuators({{.name = "u", .bounds = {-1, 1}, .actuation = {.delay_s = steps * 0.1}}}, 0.1, 0);
    EXPECT_EQ(actuators.memory(), steps);
    EXPECT_EQ(actuators.channels().front().delay_fraction, 0);
  }
}

TEST(Actuators, LagIsTheMeanOfAnExponential) {
  constexpr double kLag = 0.08;
  const Followed followed = follow(of_one({.lag_s = kLag}), Vector::Constant(15, -1));
  const auto reached = [](double t) { return -(1 - std::exp(-t / kLag)); };
  for (Index t = 0; t < 15; ++t) {
    const double begin = kDt * static_cast<double>(t), end = begin + kDt;
    // ∫ reached dt over the step, in closed form
    const double mean = -(kDt + kLag * (std::exp(-end / kLag) - std::exp(-begin / kLag))) / kDt;
    EXPECT_NEAR(followed.moving(t), mean, 1e-14);
    EXPECT_NEAR(followed.memory(t + 1, 0), reached(end), 1e-14);
  }
}

TEST(Actuators, AllTogetherComeOneAfterTheOther) {
  const Actuators actuators =
      of_one({.max_rate = 20, .filter_s = 0.03, .delay_s = 1.5 * kDt, .lag_s = 0.02, .remember = 3});
  EXPECT_EQ(actuators.memory(), 4);
  const Vector wanted{{2, 2, -2, 1, 0, 0.5, -1}};
  const Followed followed = follow(actuators, wanted);
  const double passes = 1 - std::exp(-kDt / 0.03), stays = std::exp(-kDt / 0.02), part = (1 - stays) * 0.02 / kDt;
  std::vector<double> sent = {0, 0, 0};  // before the first step
  double reached = 0;
  for (Index t = 0; t < wanted.size(); ++t) {
    const double last = sent.back(), filtered = last + passes * (wanted(t) - last);
    sent.push_back(std::min(std::max(filtered, last - 1), last + 1));
    const double held = 0.5 * sent[sent.size() - 2] + 0.5 * sent[sent.size() - 3];
    EXPECT_NEAR(followed.commands(t), sent.back(), 1e-14);
    EXPECT_NEAR(followed.moving(t), held + part * (reached - held), 1e-14);
    reached = held + stays * (reached - held);
  }
}

TEST(Actuators, MemoryFollowsFromTheCommandsAlone) {
  const Actuators actuators = of_one({.max_rate = 15, .delay_s = 0.11, .lag_s = 0.02});
  const Followed followed = follow(actuators, Vector{{2, -1, 0.3, 2, 2}});
  EXPECT_EQ(actuators.memory_of(followed.commands), followed.memory);
}

TEST(Actuators, BeginAtZeroOrAtTheNearestBound) {
  EXPECT_EQ(of_one({.remember = 2}).start(), Vector::Zero(2));
  EXPECT_EQ(of_one({.lag_s = 1, .remember = 1}, {0.5, 3}).start(), Vector::Constant(2, 0.5));
}

TEST(Actuators, StayWithinBoundsWhateverIsWanted) {
  const Actuators actuators = of_one({.max_rate = 7, .filter_s = 0.02, .delay_s = 0.07, .lag_s = 0.3}, {-1, 2});
  Vector wanted(1000);
  for (Index t = 0; t < wanted.size(); ++t) wanted(t) = std::sin(static_cast<double>(t * t)) > 0 ? 2 : -1;
  const Followed followed = follow(actuators, wanted);
  for (const Vector& values : {followed.commands, followed.moving}) {
    EXPECT_GE(values.minCoeff(), -1);
    EXPECT_LE(values.maxCoeff(), 2);
  }
}

TEST(Actuators, LeaveNaNAsItIs) {
  const Actuators actuators = of_one({.max_rate = 1, .filter_s = 1});
  Matrix U = Matrix::Constant(1, 1, kNaN);
  actuators.command(Matrix::Zero(1, 1), U);
  EXPECT_TRUE(std::isnan(U(0, 0)));
}

TEST(Actuators, ActionsHaveMemoriesOfTheirOwnBehindTheStates) {
  const Actuators actuators({{.name = "a", .unit = "N", .bounds = {-1, 1}, .actuation = {.delay_s = 2 * kDt}},
                             {.name = "b", .bounds = {-1, 1}},
                             {.name = "c", .bounds = {-3, 1}, .actuation = {.max_rate = 1, .lag_s = 0.1}}},
                            kDt, 2);
  std::vector<std::string> names;
  for (const StateVariable& variable : actuators.variables()) names.push_back(variable.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a_last", "a_last2", "c_last", "c_reached"}));
  EXPECT_EQ(actuators.variables().front().unit, "N");
  EXPECT_EQ(actuators.scale(), (Vector{{1, 1, 3, 3}}));
  Matrix X(2, 6), U(2, 3), E(2, 3), next = Matrix::Zero(2, 6);
  X << 9, 9, 0.1, 0.2, 0.3, 0.4, 9, 9, 0.5, 0.6, 0.7, 0.8;
  U << 1, 2, 3, 4, 5, 6;
  actuators.moving(X, U, E);
  EXPECT_EQ(E.col(0), (Vector{{0.2, 0.6}}));
  EXPECT_EQ(E.col(1), U.col(1));
  actuators.remember(X, U, next);
  EXPECT_EQ(next.leftCols(5), (Matrix(2, 5) << 0, 0, 1, 0.1, 3, 0, 0, 4, 0.5, 6).finished());
}

TEST(Actuators, SayWhatIsWrong) {
  const ActionVariable action{
      .name = "u",
      .bounds = {-1, 1},
      .actuation = {.max_rate = 0, .filter_s = -1, .delay_s = 11, .lag_s = kNaN, .remember = 101}};
  EXPECT_EQ(Actuators::violations(action, 0.1),
            (std::vector<std::string>{"action u: max_rate = 0, must be > 0", "action u: filter_s = -1, must be ≥ 0",
                                      "action u: delay_s = 11, must be in 0 to 10 (100 control steps)",
                                      "action u: lag_s = nan, must be ≥ 0",
                                      "action u: remember = 101, must be in 0 to 100"}));
}

TEST(WithMemory, AddsStatesThatTheTaskKnows) {
  Task task;
  task.states = {{"x", "m"}};
  task.actions = {{.name = "u", .unit = "N", .bounds = {-1, 1}, .actuation = {.delay_s = 0.2}}};
  task.start_mean = Vector{{0.5}};
  task.start_std = Vector{{0.1}};
  task.dt_s = 0.1;
  task.horizon = 3;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView r) {
    r.setZero();
  };
  EXPECT_EQ(task.violations(),
            (std::vector<std::string>{"memory = 0, must be the 2 states that its actuators remember"}));
  const Task whole = with_memory(task);
  EXPECT_TRUE(whole.violations().empty());
  EXPECT_EQ(whole.state_names(), (std::vector<std::string>{"x", "u_last", "u_last2"}));
  EXPECT_EQ(whole.start_mean, (Vector{{0.5, 0, 0}}));
  EXPECT_EQ(whole.start_std, (Vector{{0.1, 0, 0}}));
  EXPECT_EQ(whole.actuators().own_states(), 1);
}

}  // namespace
}  // namespace rehearse
