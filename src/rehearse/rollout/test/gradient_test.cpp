#include "rehearse/rollout/gradient.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "cart_rollouts.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::rollout {
namespace {

using cart::kKey;

/// The cart with drag, and the more uncertain the faster it is.
class Curved final : public dynamics::DynamicsModel {
 public:
  explicit Curved(double uncertainty = 0.1, Vector measurement_std = {})
      : uncertainty_(uncertainty), measurement_std_(std::move(measurement_std)) {}
  const Vector& measurement_std() const override { return measurement_std_; }
  bool certain() const override { return uncertainty_ == 0; }

  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    mean.col(0) = 0.1 * (U.col(0).array() - X.col(0).array() * X.col(0).array().square());
    mean.col(1) = 0.1 * X.col(0);
    variance = (uncertainty_ * (1 + X.array().square())).square();
    for (Index i = 0; i < X.rows(); ++i)
      if (X(i, 1) > 4) mean.row(i).setConstant(kNaN);
  }

 private:
  double uncertainty_;
  Vector measurement_std_;
};

/// Gradients against central differences of what `simulate` returns with the same random numbers.
void expect_gradients(const Task& task, const dynamics::DynamicsModel& model, const SimulateOptions& options = {},
                      Index particles = 70) {
  const auto policy = cart::policy();
  const Simulation simulation{model, *policy, task, kKey, options};
  const Matrix Theta = 0.5 * cart::candidates(2);
  const Candidates candidates{5, particles};
  const auto means = [&](const Matrix& at) {
    return Vector(simulate(simulation, at, candidates, serial_evaluator()).returns.colwise().mean());
  };
  const ReturnGradients found = return_gradients(simulation, Theta, candidates, serial_evaluator());
  EXPECT_LT((found.returns - means(Theta)).norm(), 1e-12);
  EXPECT_EQ(found.failed, simulate(simulation, Theta, candidates, serial_evaluator()).failed);
  for (Index i = 0; i < Theta.rows(); ++i) {
    Matrix more = Theta, less = Theta;
    more.row(i).array() += 1e-5;
    less.row(i).array() -= 1e-5;
    const Vector slope = (means(more) - means(less)) / 2e-5;
    EXPECT_LT((found.by_theta.row(i).transpose() - slope).norm(), 1e-5 * (1 + slope.norm())) << i;
  }
  EXPECT_GT(found.by_theta.norm(), 0.01);
}

TEST(ReturnGradients, AreThoseOfWhatIsSimulated) {
  const Task task = cart::task();
  for (const Index particles : {1, 3, 70}) expect_gradients(task, Curved(), {.noise_clip = 0}, particles);
  expect_gradients(task, Curved(), {.noise_clip = 1});
  expect_gradients(task, Curved(), {.sample = false});
  expect_gradients(task, Curved(0));
  expect_gradients(task, Curved(0.1, Vector{{0.3, 0.1}}));
}

TEST(ReturnGradients, KnowRewardsOfActionsAndStatesAndCosts) {
  Task task = cart::task();
  task.reward = [](const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& X_next, VectorView r) {
    for (Index i = 0; i < r.size(); ++i)
      r(i) = std::cos(X(i, 0)) - 0.1 * U(i, 0) * U(i, 0) * X(i, 1) + std::exp(-X_next(i, 1) * X_next(i, 1));
  };
  expect_gradients(task, Curved());
  task.cost = [](const Steps& steps, VectorView costs) {
    costs = steps.time_s * (steps.U - steps.U_before).col(0).array().square() + 0.1 * steps.X_next.col(0).array();
  };
  expect_gradients(task, Curved());
}

// The charge of an early end does not depend on θ.
TEST(ReturnGradients, OfEpisodesThatEndEarlyStopThere) {
  Task task = cart::task();
  task.start_mean(0) = 1;
  task.reward_floor = -2;
  task.ended = each_state([](const ConstVectorView& x) { return x(1) > 1.6; });
  expect_gradients(task, Curved());
  task.ended = nullptr;
  task.limits = {{"p", "p < 1.6", [](const Steps& steps, VectorView holds) {
                    holds = (steps.X_next.col(1).array() < 1.6).cast<double>();
                  }}};
  expect_gradients(task, Curved());
}

TEST(ReturnGradients, OfFailedEpisodesAreThoseBefore) {
  Task task = cart::task();
  task.start_mean = Vector{{0.5, 3.8}};
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next, VectorView r) {
    r = X_next.col(1).array().sin();
  };
  const auto policy = cart::policy();
  EXPECT_GT(return_gradients({Curved(), *policy, task, kKey}, cart::candidates(1), {0, 50}, serial_evaluator()).failed,
            5);
  expect_gradients(task, Curved());
}

TEST(ReturnGradients, HaveTheSameBytesForAnyNumberOfThreads) {
  const Task task = cart::task();
  const auto policy = cart::policy();
  const Curved model;
  const Simulation simulation{model, *policy, task, kKey};
  const Matrix Theta = cart::candidates(3);
  const ReturnGradients one = return_gradients(simulation, Theta, {0, 150}, serial_evaluator());
  for (const int threads : {2, 3}) {
    const auto evaluator = make_thread_evaluator(threads);
    const ReturnGradients more = return_gradients(simulation, Theta, {0, 150}, *evaluator);
    EXPECT_EQ(one.returns, more.returns);
    EXPECT_EQ(one.by_theta, more.by_theta);
  }
  EXPECT_EQ(return_gradients(simulation, Theta.col(1), {1, 150}, serial_evaluator()).by_theta, one.by_theta.col(1))
      << "a candidate does not depend on the others";
}

TEST(ReturnGradients, RefuseWhatTheyCannotKnow) {
  const Task task = cart::task();
  const auto schedule = policy::make_schedule(task);
  const Matrix Theta = Matrix::Zero(schedule->parameters(), 1);
  EXPECT_THROW(return_gradients({Curved(), *schedule, task, kKey}, Theta, {0, 1}, serial_evaluator()), InvalidInput);
  const auto policy = cart::policy();
  EXPECT_THROW(return_gradients({Curved(), *policy, task, kKey}, cart::candidates(1), {0, 0}, serial_evaluator()),
               InvalidInput);
}

}  // namespace
}  // namespace rehearse::rollout
