#include "rehearse/rollout/simulate.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "cart_rollouts.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"

namespace rehearse::rollout {
namespace {

using cart::kKey, cart::kUnclipped, cart::Noise, cart::noise_of, cart::simulate_cart, cart::start_of;

TEST(Simulate, EqualsALoopOverSingleRollouts) {
  const Task task = cart::task();
  const Matrix Theta = cart::candidates(7);
  for (const double variance : {0.0, 0.01}) {
    const Simulated simulated = simulate_cart(task, Theta, 3, kUnclipped, cart::Model(variance), 10);
    ASSERT_EQ(simulated.returns.rows(), 3);
    ASSERT_EQ(simulated.returns.cols(), 7);
    EXPECT_EQ(simulated.failed, 0);
    for (Index j = 0; j < 7; ++j) {
      for (Index p = 0; p < 3; ++p) {
        const Noise noise = noise_of(task, 10 + static_cast<std::uint64_t>(j), static_cast<std::uint64_t>(p));
        const double expected =
            cart::by_hand(task, Theta.col(j), start_of(task, noise), noise.steps, std::sqrt(variance)).value;
        EXPECT_NEAR(simulated.returns(p, j), expected, 1e-12) << j << " " << p;
      }
    }
  }
}

TEST(Simulate, NoiseIsClippedAtSoManyDeviations) {
  const Task task = cart::task();
  const Matrix Theta = cart::candidates(1);
  for (const double clip : {0.5, 1.0}) {
    const Simulated simulated = simulate_cart(task, Theta, 2, {.noise_clip = clip}, cart::Model(0.04));
    for (Index p = 0; p < 2; ++p) {
      const Noise noise = noise_of(task, 0, static_cast<std::uint64_t>(p));
      const Matrix clipped = noise.steps.cwiseMin(clip).cwiseMax(-clip);
      EXPECT_NEAR(simulated.returns(p, 0), cart::by_hand(task, Theta, start_of(task, noise), clipped, 0.2).value,
                  1e-12);
    }
  }
}

TEST(Simulate, WithoutSamplingFollowsTheMean) {
  const Task task = cart::task(0);
  const Matrix Theta = cart::candidates(3);
  const Simulated mean = simulate_cart(task, Theta, 2, {.sample = false}, cart::Model(1));
  EXPECT_EQ(mean.returns, simulate_cart(task, Theta, 2).returns);
  EXPECT_EQ(mean.returns.row(0), mean.returns.row(1)) << "the start is certain too";
}

TEST(Simulate, ThePolicySeesWhatMeasurementsAdd) {
  const Task task = cart::task();
  const Matrix Theta = cart::candidates(3);
  const Vector std{{0.3, 0.1}};
  const cart::Model noisy(0.01, {}, std), clear(0.01);
  const auto with = [&](double times) { return SimulateOptions{.noise_clip = 0, .measurement_noise = times}; };
  const Simulated once = simulate_cart(task, Theta, 2, with(1), noisy),
                  twice = simulate_cart(task, Theta, 2, with(2), noisy);
  StreamKey key = kKey;
  key.purpose = Purpose::simulated_measurement;
  for (std::uint64_t j = 0; j < 3; ++j)
    for (std::uint64_t p = 0; p < 2; ++p) {
      const Noise noise = noise_of(task, j, p);
      Matrix errors(task.horizon, 2), row(1, 2);
      for (Index t = 0; t < task.horizon; ++t) {
        fill_normals(key, &j, &p, static_cast<std::uint64_t>(t), row);
        errors.row(t) = row.cwiseProduct(std.transpose());
      }
      const auto expected = [&](double times) {
        const Vector theta = Theta.col(static_cast<Index>(j));
        return cart::by_hand(task, theta, start_of(task, noise), noise.steps, 0.1, times * errors).value;
      };
      EXPECT_NEAR(once.returns(static_cast<Index>(p), static_cast<Index>(j)), expected(1), 1e-12);
      EXPECT_NEAR(twice.returns(static_cast<Index>(p), static_cast<Index>(j)), expected(2), 1e-12);
    }
  EXPECT_EQ(simulate_cart(task, Theta, 2, with(0), noisy).returns,
            simulate_cart(task, Theta, 2, with(1), clear).returns);
  const SimulateOptions means{.sample = false};
  EXPECT_EQ(simulate_cart(task, Theta, 2, means, noisy).returns,
            simulate_cart(task, Theta, 2, {}, cart::Model(0, {}, std)).returns)
      << "uncertainty is another matter";
}

TEST(Simulate, SameBytesForAnyNumberOfThreads) {
  const Task task = cart::task();
  const Matrix Theta = cart::candidates(150);
  const Simulated one = simulate_cart(task, Theta, 5, {}, cart::Model(0.01));
  for (const int threads : {2, 3}) {
    const auto evaluator = make_thread_evaluator(threads);
    EXPECT_EQ(one.returns, simulate_cart(task, Theta, 5, {}, cart::Model(0.01), 0, *evaluator).returns);
  }
}

TEST(Simulate, ARolloutDoesNotDependOnItsBatch) {
  const Task task = cart::task();
  const Matrix Theta = cart::candidates(150);
  for (const Index particles : {3, 4}) {  // 450 and 600 rollouts: small and large chunks
    const Simulated all = simulate_cart(task, Theta, particles, {}, cart::Model(0.01));
    for (const Index j : {0, 42, 43, 85, 149}) {
      const Matrix theta = Theta.col(j);
      const auto name = static_cast<std::uint64_t>(j);
      EXPECT_EQ(simulate_cart(task, theta, particles, {}, cart::Model(0.01), name).returns, all.returns.col(j)) << j;
      EXPECT_EQ(simulate_cart(task, theta, 1, {}, cart::Model(0.01), name).returns(0, 0), all.returns(0, j))
          << "fewer particles are the first ones";
    }
  }
}

TEST(Simulate, EachCandidateMeetsItsOwnNoise) {
  const Matrix Theta = cart::candidates(1).replicate(1, 4);
  const Simulated own = simulate_cart(cart::task(), Theta, 2, {}, cart::Model(0.01));
  for (Index j = 1; j < 4; ++j) EXPECT_NE(own.returns.col(j), own.returns.col(0));
  EXPECT_NE(own.returns(0, 0), own.returns(1, 0)) << "particles differ, too";
}

/// The first step (counted from 0) whose resulting state satisfies `when`, by hand; −1: none.
Index first_step(const Matrix& states, const cart::Model::Spoil& when) {
  for (Index t = 0; t + 1 < states.rows(); ++t)
    if (when(states(t + 1, 0), states(t + 1, 1))) return t;
  return -1;
}

double reward_before(const Matrix& states, Index steps) {
  double sum = 0;
  for (Index t = 0; t < steps; ++t) sum += std::exp(-states(t + 1, 1) * states(t + 1, 1));
  return sum;
}

TEST(Simulate, AFallIsChargedTheFloorForTheRemainingSteps) {
  Task task = cart::task();
  const auto fallen = [](double, double position) { return position > 1.15; };
  task.ended = each_state([&](const ConstVectorView& x) { return fallen(x(0), x(1)); });
  const Matrix Theta = cart::candidates(40);
  const Simulated simulated = simulate_cart(task, Theta, 1);
  Index falls = 0;
  for (Index j = 0; j < 40; ++j) {
    const Noise noise = noise_of(task, static_cast<std::uint64_t>(j), 0);
    const Matrix states = cart::by_hand(task, Theta.col(j), start_of(task, noise), noise.steps, 0).states;
    const Index t = first_step(states, fallen);
    falls += t >= 0;
    const double expected =
        t < 0 ? reward_before(states, 20)
              : reward_before(states, t + 1) + static_cast<double>(task.horizon - t - 1) * task.reward_floor;
    EXPECT_NEAR(simulated.returns(0, j), expected, 1e-12) << j;
  }
  EXPECT_GT(falls, 5);
  EXPECT_LT(falls, 35);
  EXPECT_EQ(simulated.failed, 0) << "a fall is no failure";
}

TEST(Simulate, AFailureIsChargedTheFloorAndCounted) {
  const Task task = cart::task();
  const auto bad = [](double, double position) { return position > 1.15; };  // cannot be simulated from here
  const Matrix Theta = cart::candidates(40);
  const Simulated simulated = simulate_cart(task, Theta, 1, {}, cart::Model(0, bad));
  Index failures = 0;
  for (Index j = 0; j < 40; ++j) {
    const Noise noise = noise_of(task, static_cast<std::uint64_t>(j), 0);
    const Matrix states = cart::by_hand(task, Theta.col(j), start_of(task, noise), noise.steps, 0).states;
    const bool at_start = bad(states(0, 0), states(0, 1));
    const Index reached = at_start ? -1 : first_step(states, bad);  // the step after it fails
    const bool fails = at_start || (reached >= 0 && reached + 1 < task.horizon);
    failures += fails;
    const double expected =
        fails ? reward_before(states, reached + 1) + static_cast<double>(task.horizon - reached - 1) * task.reward_floor
              : reward_before(states, 20);
    EXPECT_NEAR(simulated.returns(0, j), expected, 1e-12) << j;
  }
  EXPECT_GT(failures, 5);
  EXPECT_LT(failures, 35);
  EXPECT_EQ(simulated.failed, failures);
}

TEST(Simulate, ARewardThatIsNotFiniteIsAFailureToo) {
  Task task = cart::task(0);
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView rewards) {
    rewards.setConstant(kInf);
  };
  const Simulated simulated = simulate_cart(task, cart::candidates(3), 2);
  EXPECT_EQ(simulated.failed, 6);
  EXPECT_EQ(simulated.returns, Matrix::Constant(2, 3, 20 * task.reward_floor));
}

TEST(Simulate, HugePredictionsDisturbNoOtherRollout) {
  /// Rows beyond a position come back as 1e300 or as infinities of either sign.
  class Huge final : public dynamics::DynamicsModel {
   public:
    void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
                 MatrixView variance) const override {
      model_.predict(X, U, mean, variance);
      for (Index i = 0; i < X.rows(); ++i)
        if (X(i, 1) > 1.15) mean(i, 0) = i % 2 ? 1e300 : -kInf;
    }

   private:
    cart::Model model_;
  };
  const Task task = cart::task();
  const Matrix Theta = cart::candidates(200);
  const Matrix clean = simulate_cart(task, Theta, 1).returns,
               spoilt = simulate_cart(task, Theta, 1, {}, Huge()).returns;
  EXPECT_TRUE(spoilt.allFinite());
  Index same = 0;
  for (Index j = 0; j < 200; ++j) same += clean(0, j) == spoilt(0, j);
  EXPECT_GT(same, 20);
  EXPECT_LT(same, 190);
}

TEST(Simulate, IsStoppedBetweenTheStepsOfALongHorizon) {
  Task task = cart::task();
  task.horizon = 1'000'000'000;
  int asked = 0;
  const auto evaluator = make_stoppable(make_thread_evaluator(1), [&] { return ++asked == 100; });
  EXPECT_THROW(simulate({cart::Model(), *cart::policy(), task, kKey}, cart::candidates(1), {0, 1}, *evaluator),
               Interrupted);
  EXPECT_EQ(asked, 100);
}

TEST(Simulate, WrongSizesAreRefused) {
  const Task task = cart::task();
  const auto policy = cart::policy();
  const Matrix wrong = Matrix::Zero(policy->parameters() + 1, 2), right = cart::candidates(2);
  EXPECT_THROW(simulate({cart::Model(), *policy, task, kKey}, wrong, {0, 1}, serial_evaluator()), InvalidInput);
  EXPECT_THROW(simulate({cart::Model(), *policy, task, kKey}, right, {0, 0}, serial_evaluator()), InvalidInput);
  EXPECT_THROW(simulate_recorded({cart::Model(), *policy, task, kKey}, wrong.col(0), 1), InvalidInput);
  Episodes episodes;
  EXPECT_THROW(simulate_episodes({cart::Model(), *policy, task, kKey}, right, {}, episodes), InvalidInput);
}

/// The cart, whose calls are dear.
class DearCart final : public dynamics::DynamicsModel {
 public:
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    ++calls;
    cart_.predict(X, U, mean, variance);
  }
  Index rows_at_once() const override { return 1000; }
  mutable Index calls = 0;

 private:
  cart::Model cart_;
};

TEST(Simulate, AModelWhoseCallsAreDearIsCalledTwiceAStep) {
  const Task task = cart::task();
  const Matrix Theta = cart::candidates(100);
  const DearCart dear;
  const Simulated simulated = simulate_cart(task, Theta, 3, {}, dear);
  EXPECT_EQ(dear.calls, 2 * task.horizon);
  EXPECT_LT((simulated.returns - simulate_cart(task, Theta, 3).returns).cwiseAbs().maxCoeff(), 1e-12);
}

/// A tenth of what an action changes, and the time.
void cost_of_changes(const Steps& steps, VectorView costs) {
  costs = 0.1 * (steps.U - steps.U_before).col(0).cwiseAbs().array() + steps.time_s;
}

TEST(Simulate, ACostIsSubtractedInEveryStep) {
  Task task = cart::task();
  const Matrix Theta = cart::candidates(3);
  const Recorded free = simulate_recorded({cart::Model(), *cart::policy(), task, kKey, {}}, Theta.col(1), 2);
  task.cost = cost_of_changes;
  const Recorded costly = simulate_recorded({cart::Model(), *cart::policy(), task, kKey, {}}, Theta.col(1), 2);
  Matrix u_before = Matrix::Zero(2, 1), u(2, 1);
  for (Index t = 0; t < task.horizon; ++t) {
    const auto i = static_cast<std::size_t>(t);
    ASSERT_EQ(costly.states[i], free.states[i]);
    cart::policy()->act(Theta.col(1).transpose().replicate(2, 1), free.states[i], 0, u);
    for (Index p = 0; p < 2; ++p)
      EXPECT_NEAR(free.rewards(p, t) - costly.rewards(p, t),
                  0.1 * std::abs(u(p, 0) - u_before(p, 0)) + static_cast<double>(t) * task.dt_s, 1e-12);
    u_before = u;
  }
}

}  // namespace
}  // namespace rehearse::rollout
