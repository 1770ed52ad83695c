#include "rehearse/identification/learned_reward.hpp"

#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/robots/cartpole/cartpole.hpp"

namespace rehearse::identification {
namespace {

const Task& cartpole() {
  static const Task task = robots::cartpole::make({}).task;
  return task;
}

/// n steps whose states reached lie within a metre of the centre, at any angle, with their true rewards.
Dataset steps(Index n, std::uint64_t seed) {
  Rng rng({.seed = seed});
  Dataset data{.states = Matrix(n, 4), .actions = Matrix(n, 1), .changes = Matrix(n, 4), .rewards = Vector(n)};
  for (Index i = 0; i < n; ++i) {
    data.states.row(i) << rng.uniform(-1, 1), rng.uniform(-3, 3), rng.uniform(-6, 6), rng.uniform(-M_PI, M_PI);
    data.actions(i, 0) = rng.uniform(-10, 10);
    for (double& change : data.changes.row(i)) change = rng.uniform(-0.1, 0.1);
  }
  cartpole().reward(data.states, data.actions, data.states + data.changes, data.rewards);
  return data;
}

Vector rewards_of(const Reward& reward, const Dataset& data) {
  Vector rewards(data.size());
  reward(data.states, data.actions, data.states + data.changes, rewards);
  return rewards;
}

LearnedReward learn_cartpole_reward(const Dataset& data, RewardScale scale = RewardScale::evidence) {
  RewardOptions options;
  options.scale = scale;
  return learn_reward(data, cartpole().feature_map(), options);
}

/// Root mean square error at steps that were not learned from, as a fraction of the rewards' own root mean square.
double held_out_error(const Reward& reward) {
  const Dataset held_out = steps(300, 2);
  return (rewards_of(reward, held_out) - held_out.rewards).norm() / held_out.rewards.norm();
}

std::string name_of(const ::testing::TestParamInfo<RewardScale>& scale) {
  return std::array{"linear", "logarithmic", "evidence"}.at(static_cast<std::size_t>(scale.param));
}

class EachScale : public ::testing::TestWithParam<RewardScale> {};

TEST_P(EachScale, IsCloseToTheTrueRewardOfTheCartpole) {
  const LearnedReward learned = learn_cartpole_reward(steps(300, 1), GetParam());
  EXPECT_LT(held_out_error(learned.reward), 0.05);
  EXPECT_TRUE(std::isfinite(learned.log_evidence));
  EXPECT_TRUE(learned.notes.empty());
}

TEST_P(EachScale, DependsOnTheStateReachedAndOnItsRowAlone) {
  const Dataset data = steps(60, 1);
  const Reward reward = learn_cartpole_reward(data, GetParam()).reward;
  const Vector all = rewards_of(reward, data);
  const Matrix elsewhere = Matrix::Zero(1, 4), reached = data.states + data.changes;
  for (Index i = 0; i < data.size(); i += 7) {
    Vector one(1);
    reward(elsewhere, data.actions.middleRows(i, 1), reached.middleRows(i, 1), one);
    EXPECT_EQ(one(0), all(i));
  }
}

TEST_P(EachScale, TakesRewardsThatAreAllTheSame) {
  for (const double value : {0.0, 1e-12, 3.0, -3.0}) {
    Dataset data = steps(30, 1);
    data.rewards.setConstant(value);
    const Vector learned = rewards_of(learn_cartpole_reward(data, GetParam()).reward, data);
    EXPECT_LT((learned.array() - value).abs().maxCoeff(), 0.02 * std::abs(value) + 1e-12) << value;
  }
}

TEST_P(EachScale, TakesRewardsThatAreHardlyMoreThanZero) {
  Dataset data = steps(30, 1);
  data.rewards.setZero();
  data.rewards(3) = 1e-305;
  EXPECT_LT(rewards_of(learn_cartpole_reward(data, GetParam()).reward, data).cwiseAbs().maxCoeff(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Scales, EachScale,
                         ::testing::Values(RewardScale::linear, RewardScale::logarithmic, RewardScale::evidence),
                         name_of);

TEST(LearnedReward, EvidenceIsOfTheRewardsWhateverTheScale) {
  const Dataset data = steps(100, 1);
  const LearnedReward linear = learn_cartpole_reward(data, RewardScale::linear),
                      logs = learn_cartpole_reward(data, RewardScale::logarithmic);
  const LearnedReward likelier = learn_cartpole_reward(data);
  EXPECT_EQ(likelier.log_evidence, std::max(linear.log_evidence, logs.log_evidence));
  EXPECT_EQ(likelier.scale, logs.log_evidence >= linear.log_evidence ? RewardScale::logarithmic : RewardScale::linear);

  // Evidence is a density of the rewards: in other units it falls by ln(factor) a row, on every scale.
  Dataset scaled = data;
  scaled.rewards *= 100;
  for (const auto& [scale, before] : {std::pair{RewardScale::linear, linear}, {RewardScale::logarithmic, logs}})
    EXPECT_NEAR(learn_cartpole_reward(scaled, scale).log_evidence, before.log_evidence - 100 * std::log(100), 1e-3);
}

TEST(LearnedReward, OfSaturatingRewardsTheLogarithmGoesOnBeyondTheData) {
  Dataset low = steps(200, 1);
  std::vector<Index> rows;
  for (Index i = 0; i < low.size(); ++i)
    if (low.rewards(i) < 0.05) rows.push_back(i);
  low = {low.states(rows, Eigen::all), low.actions(rows, Eigen::all), low.changes(rows, Eigen::all), low.rewards(rows)};
  ASSERT_GT(low.size(), 100);
  EXPECT_LT(held_out_error(learn_cartpole_reward(low, RewardScale::logarithmic).reward),
            0.5 * held_out_error(learn_cartpole_reward(low, RewardScale::linear).reward));
}

TEST(LearnedReward, NoPredictionIsAboveTheCeiling) {
  Dataset data{.states = Matrix::Zero(20, 4), .actions = Matrix::Zero(20, 1), .changes = Matrix::Zero(20, 4)};
  data.changes.col(0).setLinSpaced(0, 1);  // the reward doubles every 0.2 m
  data.rewards = (3.5 * data.changes.col(0)).array().exp();
  RewardOptions options{};
  options.scale = RewardScale::logarithmic;
  const auto highest = [&](double ceiling) {
    options.ceiling = ceiling;
    Dataset beyond = data;
    beyond.changes.col(0).setLinSpaced(0, 3);
    return rewards_of(learn_reward(data, cartpole().feature_map(), options).reward, beyond).maxCoeff();
  };
  EXPECT_GT(highest(100), 2.1 * data.rewards.maxCoeff());
  EXPECT_NEAR(highest(2), 2 * data.rewards.maxCoeff(), 1e-6 * data.rewards.maxCoeff());
}

// The total reward predicted at 300 other steps: hardly less from 300 steps, far less from 8.
TEST(LearnedReward, CautionCostsLittleWhereThereAreDataAndMuchElsewhere) {
  const Dataset elsewhere = steps(300, 2);
  const auto share_left = [&](Index n) {
    RewardOptions mode, median;
    mode.scale = median.scale = RewardScale::logarithmic;
    median.caution = 0;
    const auto total = [&](const RewardOptions& options) {
      return rewards_of(learn_reward(steps(n, 1), cartpole().feature_map(), options).reward, elsewhere).sum();
    };
    return total(mode) / total(median);
  };
  EXPECT_GT(share_left(300), 0.98);
  EXPECT_LE(share_left(300), 1);
  EXPECT_LT(share_left(8), 0.7);
}

TEST(LearnedReward, NegativeRewardsAreLearnedLinearly) {
  Dataset data = steps(50, 1);
  data.rewards.array() -= 0.5;
  EXPECT_EQ(learn_cartpole_reward(data, RewardScale::logarithmic).scale, RewardScale::linear);
}

TEST(LearnedReward, LeavesOutWhatIsNotFiniteAndSaysSo) {
  Dataset data = steps(60, 1);
  const Vector expected = rewards_of(learn_cartpole_reward({data.states.topRows(58), data.actions.topRows(58),
                                                            data.changes.topRows(58), Vector(data.rewards.head(58))})
                                         .reward,
                                     data);
  data.rewards(58) = kNaN;
  data.rewards(59) = kInf;
  const LearnedReward learned = learn_cartpole_reward(data);
  EXPECT_EQ(rewards_of(learned.reward, data), expected);
  ASSERT_EQ(learned.notes.size(), 1u);
  EXPECT_EQ(learned.notes.front(), "2 rewards are not finite and were left out");
}

TEST(LearnedReward, NeedsData) { EXPECT_THROW(learn_cartpole_reward({}), InvalidInput); }

}  // namespace
}  // namespace rehearse::identification
