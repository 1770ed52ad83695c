#include "rehearse/learners/black_drops/hand_over.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/testing/check_learner.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder, slider::learn, slider::run_trial, slider::setting;

class HandingOver : public ::testing::TestWithParam<const char*> {};

/// The learner of this name whose policies hand over to feedback.
std::unique_ptr<LearnerBuilder> handing_over(const char* name, const char* evaluations = "300") {
  auto learner = builder(name, evaluations);
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { learner->fields(v); }, "search.hand_over", "true"));
  return learner;
}

// The slider stays at 0, where it earns most: seed 1.
TEST_P(HandingOver, HoldsTheSliderAtItsGoal) {
  EXPECT_EQ(testing::check_learner(*handing_over(GetParam()), setting(), run_trial), std::vector<std::string>{});
  const auto learner = handing_over(GetParam(), "600")->build(setting());
  const slider::History history = learn(*learner, 3);
  const Proposal& last = history.proposals.back();
  ASSERT_EQ(last.policy->name(), "hand-over");
  Matrix U(1, 1);
  for (const double position : {-0.05, 0.05}) {
    last.policy->act(last.theta.transpose(), Matrix{{position}}, 0, U);
    EXPECT_LT(U(0, 0) * position, 0) << "back to 0";
  }
  EXPECT_GT(history.returns.back(), 8.5);
  EXPECT_NEAR(history.returns.back(), *last.predicted_return, 1);
}

INSTANTIATE_TEST_SUITE_P(Names, HandingOver, ::testing::ValuesIn(slider::kNames), [](const auto& info) {
  std::string name = info.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(HandOver, IsNotThereWhereNoStateCanBeHeld) {
  /// A slider that drifts faster than it can be pulled.
  const auto drifts = [](const Vector&, const Vector& u, const Vector& phi, Vector& dxdt) {
    dxdt(0) = phi(0) * u(0) + 5;
  };
  const ParameterSpace space({Parameter::continuous("gain", 1, {0, 2})});
  Setting drifting = setting(prior::Prior{"drift", system::make_ode_simulator(drifts, space, 0.2, 4), space});
  const auto learner = handing_over("gp-mi")->build(drifting);
  const Proposal& proposal = learner->ask();
  EXPECT_EQ(proposal.policy, drifting.policy);
  ASSERT_FALSE(proposal.notes.empty());
  EXPECT_EQ(proposal.notes.front(), kNoGoal);
}

/// A cart that earns by going fast, and by staying near the place where it stands.
Setting runner(double for_speed) {
  const auto ode = [](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) {
    dxdt << u(0) - 0.3 * x(0), x(0);
  };
  Setting setting;
  setting.task.states = {{"speed", "m/s"}, {"place", "m"}};
  setting.task.actions = {{"push", "N", {-1, 1}}};
  setting.task.start_mean = Vector{{0, 0.2}};
  setting.task.start_std = Vector::Zero(2);
  setting.task.dt_s = 0.1;
  setting.task.horizon = 100;
  setting.task.reward = [for_speed](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& next,
                                    VectorView rewards) {
    rewards = for_speed * next.col(0).array() - 0.01 * next.col(1).array().square();
  };
  setting.policy =
      policy::make_linear({.features = setting.task.feature_map(), .scale = Vector::Ones(2), .squash = {{{-1, 1}}, 1}});
  setting.prior = prior::Prior{"runner", system::make_ode_simulator(ode, {}, 0.1, 4), {}};
  return setting;
}

// Feedback holds the cart where it starts: seed 1.
TEST(HandOver, FromTheStartOnMustBeBetterThanNone) {
  const Proposal runs = handing_over("black-drops-prior")->build(runner(1))->ask();
  EXPECT_EQ(runs.policy->name(), "linear");
  ASSERT_FALSE(runs.notes.empty());
  EXPECT_EQ(runs.notes.front(), kHeldAtStart);
  EXPECT_GT(*runs.predicted_return, 20) << "held, it earns next to nothing";
  const Proposal stays = handing_over("black-drops-prior", "32")->build(runner(0))->ask();
  EXPECT_EQ(stays.policy->name(), "hand-over");
  EXPECT_EQ(stays.notes, std::vector<std::string>{});
}

TEST(HandOver, IsRefusedWhereItCannotBe) {
  const auto refused = [](const Setting& with, const char* method) {
    const auto learner = handing_over("gp-mi");
    set_field([&](FieldVisitor& v) { learner->fields(v); }, "search.method", method);
    try {
      (void)learner->build(with);
      return std::string();
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(refused(setting(), "gradient").find("search.hand_over = true, but search.method"), std::string::npos);
  Setting filtered = setting();
  filtered.task.actions[0].actuation.filter_s = 0.3;
  filtered.task = with_memory(filtered.task);
  filtered.policy = policy::make_linear(
      {.features = filtered.task.feature_map(), .scale = Vector::Ones(2), .squash = {{{-1, 1}}, 1}});
  EXPECT_NE(refused(filtered, "race").find("search.hand_over = true, but commands are filtered"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
