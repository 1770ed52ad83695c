#include "rehearse/learners/black_drops/simulated_return.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

/// The slider may not go below a position.
struct SimulatedReturnTest : ::testing::Test {
  void limit(double low) {
    const auto holds = [low](const Steps& steps, VectorView kept) {
      kept = (steps.X_next.col(0).array() > low).cast<double>();
    };
    task.limits = {{"end", "position > low", holds, 0.05}};
  }
  const dynamics::SimulatorModel model{slider::prior(), slider::kTruth, 0.0004};
  const std::shared_ptr<const policy::Policy> policy = slider::policy();
  Task task = slider::task();
  const ProgressSink nobody;
  SearchProblem problem{model, *policy, task, serial_evaluator(), nobody};
  SearchOptions options;
  const StreamKey key{.seed = 1, .stage = Stage::search};
  const Matrix pulls{{-5, -1, 0, 5}, {0, 0, 0, 0}};  // the first goes to 0, the third stays near 1
};

TEST_F(SimulatedReturnTest, IsTheMeanReturnWithoutLimits) {
  SimulatedReturn objective(problem, options, key);
  Vector values(4);
  objective(pulls, 0, 10, values);
  const auto expected =
      rollout::simulate({model, *policy, task, key, options.simulate}, pulls, {0, 10}, serial_evaluator());
  EXPECT_EQ(values, expected.returns.colwise().mean().transpose());
  EXPECT_EQ(objective.rollouts(), 40);
  EXPECT_EQ(objective.next(), 4u);
}

TEST_F(SimulatedReturnTest, IsLessThanThatOfAnyPolicyThatKeepsTheLimits) {
  SimulatedReturn free(problem, options, key);
  Vector unlimited(4), values(4);
  free(pulls, 0, 10, unlimited);
  EXPECT_GT(unlimited(0), unlimited(2) + 1) << "it is the better one";
  limit(0.5);
  options.constrained = true;
  SimulatedReturn objective(problem, options, key);
  objective(pulls, 0, 10, values);
  EXPECT_LT(values(0), values(2));
  EXPECT_LT(values(0), values(3));
  EXPECT_LT(values(0), values(1)) << "broken later";
  EXPECT_EQ(values(2), unlimited(2));
}

TEST_F(SimulatedReturnTest, OfASearchThatIsNotConstrainedEndsWhereALimitIsBroken) {
  limit(0.5);
  SimulatedReturn objective(problem, options, key);
  Vector values(4);
  objective(pulls, 0, 10, values);
  const auto expected =
      rollout::simulate({model, *policy, task, key, options.simulate}, pulls, {0, 10}, serial_evaluator());
  EXPECT_EQ(values, expected.returns.colwise().mean().transpose());
}

TEST_F(SimulatedReturnTest, MeasuresHowOftenLimitsAreBroken) {
  limit(0.5);
  SimulatedReturn objective(problem, options, key);
  const auto measured = objective.measure(pulls, 0, 50);
  EXPECT_EQ(measured[0].risks[0].broken, 50);
  EXPECT_EQ(measured[0].risks[0].episodes, 50);
  EXPECT_GT(measured[0].early, 0.5);
  EXPECT_LE(measured[0].early, 1);
  EXPECT_EQ(measured[2].risks[0].broken, 0);
  EXPECT_EQ(measured[2].early, 0);
}

TEST_F(SimulatedReturnTest, JudgesRisksButNoReturnsWithCaution) {
  limit(0.42);
  const auto measured = [&](double caution) {
    options.simulate.noise_clip = 0;
    options.safety.caution = caution;
    SimulatedReturn objective(problem, options, key);
    return objective.measure(pulls.col(2), 0, 200)[0];
  };
  const Measurement plain = measured(1), cautious = measured(4);
  EXPECT_LT(plain.risks[0].broken, 10);
  EXPECT_GT(cautious.risks[0].broken, 20);
  EXPECT_GT(cautious.early, plain.early);
  EXPECT_EQ(cautious.mean, plain.mean);
}

TEST_F(SimulatedReturnTest, OfAConstrainedSearchIsCautious) {
  limit(0.42);
  options.constrained = true;
  const auto value = [&](double caution) {
    options.simulate.noise_clip = 0;
    options.safety.caution = caution;
    SimulatedReturn objective(problem, options, key);
    Vector values(2);
    objective(pulls.rightCols(2), 0, 200, values);
    return Vector(values.array() - values(1));  // the last goes away from the limit
  };
  EXPECT_GT(value(1)(0), 0) << "safe, and nearer to the goal";
  EXPECT_LT(value(4)(0), 0);
}

TEST_F(SimulatedReturnTest, GoesRoundTheModelsThatAreDoubted) {
  const auto still = std::make_shared<dynamics::SimulatorModel>(slider::prior(), Vector{{0, 0}});
  const auto strong = std::make_shared<dynamics::SimulatorModel>(slider::prior(), slider::kTruth);
  task.start_std.setZero();
  limit(0.5);
  problem.doubted = {still, strong};
  SimulatedReturn objective(problem, options, key);
  const Matrix pull = pulls.leftCols(1);
  EXPECT_EQ(objective.measure(pull, 0, 9)[0].risks[0].broken, 4);
  EXPECT_EQ(objective.measure(pull, 1, 9)[0].risks[0].broken, 5) << "it goes on with the second";
  EXPECT_EQ(objective.measure(pulls, 2, 2)[0].risks[0].broken, 1);
  EXPECT_EQ(objective.rollouts(), 26);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
