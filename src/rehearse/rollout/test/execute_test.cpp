#include "rehearse/rollout/execute.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "cart.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::rollout {
namespace {

/// The cart of cart.hpp, measured 0.01 too far; keeps what it was asked.
class CartPlant final : public system::Plant {
 public:
  explicit CartPlant(bool knows_truth = true) : knows_truth_(knows_truth) {}
  Vector reset(Rng& rng) override {
    x_ = Vector{{0, 1 + 0.1 * rng.normal()}};
    return measured();
  }
  Vector step(const Vector& u) override {
    actions.push_back(u(0));
    x_ += Vector{{0.1 * u(0), 0.1 * x_(0)}};
    if (static_cast<Index>(actions.size()) == fails_at) return failure();
    return measured();
  }
  Vector truth() const override { return knows_truth_ ? x_ : Vector(); }
  void finish() noexcept override { ++finished; }

  std::vector<double> actions;
  Index fails_at = -1;
  int finished = 0;
  std::function<Vector()> failure;

 private:
  Vector measured() const { return x_.array() + 0.01; }
  Vector x_;
  bool knows_truth_;
};

const Rng kRng({.seed = 5, .trial = 1, .purpose = Purpose::start_state});

TEST(Execute, RefusesParametersOfAnotherPolicy) {
  CartPlant plant;
  EXPECT_THROW(execute(plant, *cart::policy(), Vector::Zero(40), cart::task(), kRng), InvalidInput);
  Task two = cart::task();
  two.actions.push_back({"torque", "N m", {-1, 1}});
  EXPECT_THROW(execute(plant, *cart::policy(), cart::candidates(1), two, kRng), InvalidInput);
  EXPECT_TRUE(plant.actions.empty());
}

// Measured 0.01 too far: what was earned is that of such states, and all else is as it was.
TEST(Execute, AsMeasuredEarnsWhatTheMeasuredStatesDo) {
  const Task task = cart::task();
  CartPlant plant;
  const Episode episode = execute(plant, *cart::policy(), cart::candidates(1), task, kRng);
  const Episode measured = as_measured(episode, task);
  EXPECT_EQ(measured.true_states, episode.states);
  EXPECT_EQ(measured.states, episode.states);
  EXPECT_EQ(measured.actions, episode.actions);
  Vector rewards(episode.steps());
  task.reward(episode.states.topRows(20), episode.actions, episode.states.bottomRows(20), rewards);
  EXPECT_TRUE(measured.rewards.isApprox(rewards, 1e-14));
  EXPECT_NE(measured.total_reward(), episode.total_reward());
  CartPlant without_truth(false);
  const Episode same = execute(without_truth, *cart::policy(), cart::candidates(1), task, kRng);
  EXPECT_EQ(as_measured(same, task).rewards, same.rewards);
}

TEST(Execute, RecordsWhatHappened) {
  const Task task = cart::task();
  CartPlant plant;
  const Vector theta = cart::candidates(1);
  const Episode episode = execute(plant, *cart::policy(), theta, task, kRng);
  ASSERT_EQ(episode.steps(), 20);
  EXPECT_EQ(plant.finished, 1);
  ASSERT_EQ(episode.states.rows(), 21);
  ASSERT_EQ(episode.true_states.rows(), 21);
  EXPECT_FALSE(episode.ended);
  EXPECT_EQ(episode.charged, 0);
  EXPECT_LT((episode.states.array() - episode.true_states.array() - 0.01).abs().maxCoeff(), 1e-15);
  Matrix u(1, 1);
  for (Index t = 0; t < 20; ++t) {
    cart::policy()->act(theta.transpose(), episode.states.row(t), 0, u);
    EXPECT_EQ(episode.actions(t, 0), u(0, 0)) << "the policy sees the measured state";
    EXPECT_EQ(episode.actions(t, 0), plant.actions[static_cast<std::size_t>(t)]);
    const double p = episode.true_states(t + 1, 1);
    EXPECT_DOUBLE_EQ(episode.rewards(t), std::exp(-p * p)) << "the reward sees the true state reached";
  }
  EXPECT_DOUBLE_EQ(episode.total_reward(), episode.rewards.sum());
}

TEST(Execute, SameStreamSameBytes) {
  CartPlant a, b;
  const Vector theta = cart::candidates(1);
  EXPECT_EQ(execute(a, *cart::policy(), theta, cart::task(), kRng).states,
            execute(b, *cart::policy(), theta, cart::task(), kRng).states);
  const Rng other({.seed = 6, .trial = 1, .purpose = Purpose::start_state});
  EXPECT_NE(execute(a, *cart::policy(), theta, cart::task(), other).states,
            execute(b, *cart::policy(), theta, cart::task(), kRng).states);
}

TEST(Execute, WithoutTruthTheMeasuredStateStandsForIt) {
  CartPlant plant(false);
  const Episode episode = execute(plant, *cart::policy(), cart::candidates(1), cart::task(), kRng);
  EXPECT_EQ(episode.states, episode.true_states);
}

TEST(Execute, AFallEndsTheEpisodeAndIsChargedTheFloor) {
  Task task = cart::task();
  int asked = 0;
  task.ended = each_state([&](const ConstVectorView&) { return ++asked == 7; });
  CartPlant plant;
  const Episode episode = execute(plant, *cart::policy(), cart::candidates(1), task, kRng);
  EXPECT_TRUE(episode.ended);
  EXPECT_EQ(episode.steps(), 7);
  EXPECT_EQ(plant.actions.size(), 7u);
  EXPECT_EQ(episode.states.rows(), 8);
  EXPECT_EQ(episode.true_states.rows(), 8);
  EXPECT_EQ(episode.rewards.size(), 7);
  EXPECT_DOUBLE_EQ(episode.charged, 13 * task.reward_floor);
  EXPECT_DOUBLE_EQ(episode.total_reward(), episode.rewards.sum() + 13 * task.reward_floor);
}

TEST(Execute, AFallAtTheLastStepIsChargedNothing) {
  Task task = cart::task();
  int asked = 0;
  task.ended = each_state([&](const ConstVectorView&) { return ++asked == 20; });
  CartPlant plant;
  const Episode episode = execute(plant, *cart::policy(), cart::candidates(1), task, kRng);
  EXPECT_TRUE(episode.ended);
  EXPECT_EQ(episode.steps(), 20);
  EXPECT_EQ(episode.charged, 0);
}

/// Ends its episodes by itself.
class EndingPlant final : public system::Plant {
 public:
  Vector reset(Rng& rng) override { return steps_ = 0, plant_.reset(rng); }
  Vector step(const Vector& u) override { return ++steps_, plant_.step(u); }
  bool ended() const override { return steps_ == 4; }

 private:
  CartPlant plant_;
  int steps_ = 0;
};

TEST(Execute, APlantMayEndTheEpisode) {
  EndingPlant plant;
  const Task task = cart::task();
  const Episode episode = execute(plant, *cart::policy(), cart::candidates(1), task, kRng);
  EXPECT_TRUE(episode.ended);
  EXPECT_EQ(episode.failure, "");
  EXPECT_EQ(episode.steps(), 4);
  EXPECT_DOUBLE_EQ(episode.charged, 16 * task.reward_floor);
}

TEST(Execute, APlantThatThrowsReachesTheCaller) {
  CartPlant plant;
  plant.fails_at = 3;
  plant.failure = []() -> Vector { throw std::runtime_error("no answer"); };
  const auto run = [&] { execute(plant, *cart::policy(), cart::candidates(1), cart::task(), kRng); };
  EXPECT_EQ(message_of<std::runtime_error>(run), "no answer");
  EXPECT_EQ(plant.finished, 1);
}

TEST(Execute, AStateThatIsNoStateIsAnError) {
  const auto why = [](const Vector& state) -> std::string {
    CartPlant plant;
    plant.fails_at = 3;
    plant.failure = [&] { return state; };
    const auto run = [&] { execute(plant, *cart::policy(), cart::candidates(1), cart::task(), kRng); };
    return message_of<std::runtime_error>(run);
  };
  const std::string name = cart::task().states[1].name;
  EXPECT_NE(why(Vector::Zero(3)).find(" has 3 entries, must have 2"), std::string::npos);
  EXPECT_NE(why(Vector()).find(" has 0 entries, must have 2"), std::string::npos);
  EXPECT_NE(why(Vector{{0, kNaN}}).find(" has " + name + " = nan, must be finite"), std::string::npos);
  EXPECT_NE(why(Vector{{kInf, 0}}).find(" = inf, must be finite"), std::string::npos);
  EXPECT_NE(why(Vector{{-1e30, 0}}).find(" = -1e+30, must be within ±1e+12"), std::string::npos);
}

TEST(Execute, ARewardThatIsNotFiniteEndsTheEpisodeAtTheFloor) {
  for (const double bad : {kNaN, kInf}) {
    Task task = cart::task();
    int steps = 0;
    task.reward = [&](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView rewards) {
      rewards.setConstant(++steps % 7 == 0 ? bad : 1);
    };
    CartPlant plant;
    const Episode episode = execute(plant, *cart::policy(), cart::candidates(1), task, kRng);
    EXPECT_EQ(episode.failure, "the reward at step 7 is not finite");
    EXPECT_TRUE(episode.ended);
    EXPECT_EQ(episode.steps(), 7) << "its states are known";
    EXPECT_DOUBLE_EQ(episode.total_reward(), 6 + 14 * task.reward_floor);
    EXPECT_EQ(as_measured(episode, task).rewards, episode.rewards) << "by measured states, too";
  }
}

/// A policy whose fourth action is another.
struct Broken final : policy::Policy {
  explicit Broken(double action) : fourth(action) {}
  std::string name() const override { return "broken"; }
  Index parameters() const override { return 1; }
  Index actions() const override { return 1; }
  void act(const ConstMatrixView&, const ConstMatrixView&, double t_s, MatrixView U) const override {
    U.setConstant(t_s < 0.25 ? 1 : fourth);
  }
  double fourth;
};

TEST(Execute, AnActionOutOfItsBoundsNeverReachesThePlant) {
  const std::vector<std::pair<double, std::string>> wrong = {
      {std::nan(""), "an action at step 3 is not finite"},
      {-2.5, "the policy's action force at step 3 is -2.5, must be in -2 to 2"}};
  for (const auto& [action, why] : wrong) {
    CartPlant plant;
    const Episode episode = execute(plant, Broken(action), Vector::Zero(1), cart::task(), kRng);
    EXPECT_EQ(plant.actions, (std::vector<double>{1, 1, 1}));
    EXPECT_EQ(episode.failure, why);
    EXPECT_TRUE(episode.ended);
    EXPECT_DOUBLE_EQ(episode.charged, 17 * cart::task().reward_floor);
  }
}

TEST(Execute, MayBeStoppedBeforeAnyStep) {
  struct Stop {};
  CartPlant plant;
  const auto stop = [&] {
    if (plant.actions.size() == 5) throw Stop{};
  };
  EXPECT_THROW(execute(plant, *cart::policy(), cart::candidates(1), cart::task(), kRng, stop), Stop);
  EXPECT_EQ(plant.actions.size(), 5u);
}

TEST(Execute, ATruthThatIsNoStateIsNamed) {
  class Doubtful final : public system::Plant {
   public:
    Vector reset(Rng&) override { return Vector{{0, 0}}; }
    Vector step(const Vector&) override { return Vector{{0, 0}}; }
    Vector truth() const override { return Vector{{0, NAN}}; }
  } plant;
  EXPECT_EQ(
      message_of<std::runtime_error>([&] { execute(plant, *cart::policy(), cart::candidates(1), cart::task(), kRng); }),
      "the plant's true state at step 0 has p = nan, must be finite");
}

TEST(Execute, ACostIsSubtractedInEveryStep) {
  Task task = cart::task();
  CartPlant plant, same;
  const Episode free = execute(plant, *cart::policy(), cart::candidates(1), task, kRng);
  task.cost = [](const Steps& steps, VectorView costs) {
    costs = (steps.U - steps.U_before).col(0).array().square() + steps.time_s;
  };
  const Episode costly = execute(same, *cart::policy(), cart::candidates(1), task, kRng);
  for (Index t = 0; t < task.horizon; ++t) {
    const double change = free.actions(t, 0) - (t > 0 ? free.actions(t - 1, 0) : 0);
    EXPECT_NEAR(free.rewards(t) - costly.rewards(t), change * change + static_cast<double>(t) * task.dt_s, 1e-12);
  }
}

}  // namespace
}  // namespace rehearse::rollout
