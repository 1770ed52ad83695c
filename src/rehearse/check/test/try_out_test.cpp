#include "rehearse/check/try_out.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/robot_file/test/example.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::check {
namespace {

namespace example = robot_file::example;
using example::kSwing, example::with, robot_file::builder;

Tried tried(const std::string& text) { return try_out(builder(text, "swing.toml", example::no_files)->build()); }

TEST(TryOut, SaysHowFarPriorAndPlantAreApart) {
  const Tried found = tried(kSwing);
  EXPECT_EQ(found.steps, 60);
  EXPECT_FALSE(found.end);
  EXPECT_EQ(found.broken, std::vector<std::string>{});
  EXPECT_NEAR(found.start_reward, std::exp(-2 * (1 - std::cos(3)) / (2 * 0.25)), 1e-12);
  ASSERT_EQ(found.priors.size(), 1u);
  EXPECT_GT(found.priors[0].error(0), 0.01 * found.change(0));
  EXPECT_LT(found.priors[0].error(0), found.change(0));
  EXPECT_GT(found.priors[0].rows_per_s, 0);
  EXPECT_EQ(found.priors[0].failed, 0);
  EXPECT_EQ(found.priors[0].idle, std::vector<std::string>{});
  const Tried right = tried(with("parameters.m = 1.3\ntune.m = [0.5, 2]", ""));
  EXPECT_LT(right.priors[0].error(0), 1e-6);
}

TEST(TryOut, NamesARewardThatIsNoNumber) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  scenario.task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next,
                            VectorView rewards) { rewards = 1 / X_next.col(0).array(); };
  const Tried found = try_out(scenario);
  EXPECT_EQ(found.broken, std::vector<std::string>{"the reward of the start is inf, must be a finite number"});
}

TEST(TryOut, SaysHowAPlantDoesNotRepeatItself) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  const scenario::NamedPrior prior = scenario.priors[0];
  double start = 0;
  scenario.make_plant = [&] {
    start += 0.01;  // a robot is never put down at the same place
    return system::make_simulated_plant(prior.simulator, prior.parameters.values(),
                                        {scenario.task.start_mean.array() + start, scenario.task.start_std, {}});
  };
  const Tried found = try_out(scenario);
  ASSERT_EQ(found.broken.size(), 1u);
  EXPECT_NE(found.broken[0].find("the same random numbers (60 of 60 rows, "), std::string::npos) << found.broken[0];
  EXPECT_NE(found.broken[0].find("--no-plant"), std::string::npos);
}

TEST(TryOut, NamesARobotThatNothingMoves) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  const scenario::NamedPrior& prior = scenario.priors[0];
  const auto still = system::make_simulator(prior.parameters,
                                            [](const auto&, const auto&, const auto&, MatrixView dX) { dX.setZero(); });
  scenario.make_plant = [&] {
    return system::make_simulated_plant(still, prior.parameters.values(),
                                        {scenario.task.start_mean, scenario.task.start_std, {}});
  };
  EXPECT_EQ(try_out(scenario).broken,
            std::vector<std::string>{"no step changes any state: is a formula infinite where it starts?"});
}

TEST(TryOut, NamesAStartWhereEpisodesEnd) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  scenario.task.ended = each_state([](const ConstVectorView& state) { return state(1) > 2; });
  const Tried found = try_out(scenario);
  EXPECT_EQ(found.broken, std::vector<std::string>{"an episode ends where it starts: `ended` holds in the start"});
  EXPECT_EQ(found.ended, 3);
}

/// A plant that falls in its second step.
class Falling final : public system::Plant {
 public:
  Vector reset(Rng&) override { return at(0); }
  Vector step(const Vector&) override { return at(time_ + 1); }
  bool ended() const override { return time_ >= 2; }

 private:
  Vector at(int time) {
    time_ = time;
    return Vector::Constant(2, time);
  }

  int time_ = 0;
};

TEST(TryOut, APlantMayEndAnEpisode) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  scenario.make_plant = [] { return std::make_unique<Falling>(); };
  const Tried found = try_out(scenario);
  EXPECT_EQ(found.ended, 3);
  EXPECT_EQ(found.steps, 6);
  const auto unknown = [&](const std::vector<std::string>& notes) {
    return std::ranges::count(
        notes,
        "the plant itself ended 3 of 3 episodes, which no simulated episode knows: say when it ends "
        "by `ended`, or by a limit");
  };
  EXPECT_EQ(unknown(found.notes), 1);
  scenario.task.ended = each_state([](const ConstVectorView& state) { return state(1) >= 2; });
  EXPECT_EQ(unknown(try_out(scenario).notes), 0);
}

TEST(TryOut, CountsEpisodesThatBreakALimitAndNamesOneThatTheStartBreaks) {
  const Tried found = tried(kSwing + "[[limit]]\nname = \"far\"\nkeep = \"angle < 2\"\n[[limit]]\nkeep = \"u < 9\"\n");
  EXPECT_EQ(found.broken, std::vector<std::string>{"limit far: the start breaks it, and the first step of every "
                                                   "episode: keep says what must hold"});
  EXPECT_EQ(found.limits, (std::vector<Index>{3, 0}));
  EXPECT_EQ(found.steps, 3) << "a broken limit ends an episode, as it ends a trial";
  const Tried random = tried(kSwing + "[[limit]]\nkeep = \"abs(u) < 1e-9\"\n");
  EXPECT_EQ(random.broken, std::vector<std::string>{}) << "actions may be smaller than random ones";
  EXPECT_EQ(random.limits, std::vector<Index>{3});
}

TEST(TryOut, SaysWhereFallingPays) {
  const std::string reward = "distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5";
  const auto with_end = [](std::string text) {
    const std::string dt = "dt_s = 0.1";
    return text.replace(text.find(dt), dt.size(), dt + "\nended = \"abs(rate) > 100\"");
  };
  const std::string negative = with(reward, "formula = \"-1 - 0.5 * (height > 2)\"");
  EXPECT_EQ(
      tried(with_end(negative)).notes,
      std::vector<std::string>{"steps under random actions earn about -1, and each step that is left after a fall "
                               "earns reward.floor = 0: falling pays, unless the goal earns more; floor = -1 would "
                               "be safe"});
  EXPECT_FALSE(tried(with_end(with(reward, "formula = \"1\"\ncost = \"2\""))).notes.empty()) << "costs count";
  EXPECT_TRUE(tried(negative).notes.empty()) << "nothing ends its episodes";
  EXPECT_TRUE(tried(with_end(with(reward, "formula = \"-1\"\nfloor = -1"))).notes.empty());
  EXPECT_TRUE(tried(with_end(kSwing)).notes.empty());
  const auto nothing = tried(with_end(with(reward, "formula = \"0\"\nfloor = 1"))).notes;
  ASSERT_EQ(nothing.size(), 1U);
  EXPECT_TRUE(nothing.front().ends_with("floor = 0 would be safe")) << nothing.front();
  EXPECT_FALSE(tried(negative + "[[limit]]\nkeep = \"abs(rate) < 100\"\n").notes.empty());
  const auto fails = tried(with(reward, "formula = \"-1 - 1e-9 * sqrt(1.8 - abs(u))\"")).notes;
  ASSERT_FALSE(fails.empty());
  EXPECT_TRUE(fails.back().ends_with("floor = -1.1 would be safe")) << "failures pay like falls: " << fails.back();
}

TEST(TryOut, SaysWhereWholeTurnsCount) {
  const std::string reward = "distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5";
  const Tried found = tried(with(reward, "formula = \"-abs(angle)\""));
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_EQ(found.notes[0].find("the reward says something else when angle is a whole turn further"), 0u);
  EXPECT_EQ(found.broken, std::vector<std::string>{});
}

TEST(TryOut, ARobotThatFailsIsNotMovedAgain) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  int steps = 0;
  scenario.make_plant = [&steps] {
    const auto motion = [&steps](const Vector& x, const Vector&) -> Vector {
      if (++steps == 4) throw std::runtime_error("the motor is hot");
      return x + Vector::Ones(2);
    };
    return system::make_simulated_plant(motion, {Vector::Zero(2), Vector::Zero(2), {}});
  };
  const Tried found = try_out(scenario);
  EXPECT_EQ(found.end, "the plant failed in step 4 of episode 1: the motor is hot");
  EXPECT_TRUE(found.played) << "the prior is tried all the same";
  EXPECT_EQ(found.steps, 60);
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(found.broken, std::vector<std::string>{});
}

TEST(TryOut, StopsWhereItIsAskedTo) {
  int asked = 0;
  const auto stops = make_stoppable(make_thread_evaluator(1), [&] { return ++asked == 3; });
  EXPECT_THROW(try_out(builder(kSwing, "swing.toml", example::no_files)->build(), *stops), Interrupted);
}

TEST(TryOut, APlantThatFailsWithoutAWordFails) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  scenario.make_plant = [] {
    const auto motion = [](const Vector&, const Vector&) -> Vector { throw std::runtime_error(""); };
    return system::make_simulated_plant(motion, {Vector::Zero(2), Vector::Zero(2), {}});
  };
  const Tried found = try_out(scenario);
  EXPECT_EQ(found.end, "the plant failed in step 1 of episode 1: it does not say why");
}

TEST(TryOut, NamesAPlantThatLosesItsWay) {
  const Tried found = tried(with("define.torque = \"u +", "define.torque = \"sqrt(-abs(rate)) +"));
  ASSERT_TRUE(found.end);
  EXPECT_NE(found.end->find("rate = nan, must be finite"), std::string::npos) << *found.end;
}

TEST(TryOut, NotesARewardThatIsNotFinite) {
  const Tried found =
      tried(with("distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5", "formula = \"sqrt(3 - angle)\""));
  ASSERT_FALSE(found.notes.empty());
  EXPECT_EQ(found.notes[0].find("an episode of random actions ended: the reward at step "), 0u) << found.notes[0];
  EXPECT_EQ(found.ended, 0) << "it did not fall";
}

}  // namespace
}  // namespace rehearse::check
