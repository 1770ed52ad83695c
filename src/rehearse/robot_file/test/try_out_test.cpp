#include "rehearse/robot_file/try_out.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::robot_file {
namespace {

using example::kSwing, example::with;

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

TEST(TryOut, NamesAParameterThatChangesNothing) {
  const std::string unused = with("m = 1, l", "m = 1, k = 3, l");
  const Tried found = tried(unused + "tune.k = [1, 5]\n");
  EXPECT_EQ(found.priors[0].idle, std::vector<std::string>{"k"});
}

// 9.81 · 0.3 k / (0.3 k) has other last bits for another k.
TEST(TryOut, AParameterThatCancelsChangesNothing) {
  std::string text = with("m = 1, l", "m = 1, k = 3, l");
  const std::string gravity = "9.81";
  text.replace(text.find(gravity), gravity.size(), "(9.81 * 0.3 * k / (k * 0.3))");
  EXPECT_EQ(tried(text + "tune.k = [1, 5]\n").priors[0].idle, std::vector<std::string>{"k"});
}

TEST(TryOut, AParameterThatActsFarFromTheStartIsFound) {
  const std::string contact = with("define.torque = \"u +", "define.torque = \"u - where(abs(rate) > 40, k, 0) +");
  std::string text = contact;
  const std::string values = "m = 1, l";
  text.replace(text.find(values), values.size(), "m = 1, k = 3, l");
  const Tried found = tried(text + "tune.k = [1, 5]\n");
  EXPECT_EQ(found.priors[0].idle, std::vector<std::string>{});
  EXPECT_EQ(found.priors[0].states, 2 * found.steps);
}

/// The swing with a prior of its own.
Tried tried_with(system::Change change) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  scenario.priors[0].simulator = system::make_simulator(scenario.priors[0].parameters, std::move(change));
  return try_out(scenario);
}

TEST(TryOut, APriorMustRepeatItself) {
  Rng noise({.seed = 1});
  const Tried found = tried_with([&](const auto& X, const auto&, const auto&, MatrixView dX) {
    dX = X;
    dX(0, 1) += noise.uniform();
  });
  const std::string start =
      "predicts something else from the same states and actions a second time (1 of 60 rows, angle by ";
  EXPECT_EQ(found.priors[0].broken.find(start), 0u) << found.priors[0].broken;
  EXPECT_EQ(tried(kSwing).priors[0].broken, "");
}

TEST(TryOut, RoundingThatDiffersIsSaidButNoFault) {
  Rng noise({.seed = 1});
  const Tried found = tried_with([&](const auto& X, const auto&, const auto&, MatrixView dX) {
    dX = X;
    dX(0, 1) += 1e-13 * noise.uniform();
  });
  EXPECT_EQ(found.priors[0].broken, "");
  ASSERT_FALSE(found.priors[0].notes.empty());
  EXPECT_NE(found.priors[0].notes[0].find("asked for again (1 of 60 rows, angle by "), std::string::npos);
  EXPECT_EQ(tried(kSwing).priors[0].notes, std::vector<std::string>{});
}

TEST(TryOut, APriorThatGivesTheNextStateIsAskedAboutIt) {
  scenario::Scenario scenario = builder(kSwing, "swing.toml", example::no_files)->build();
  const auto right = scenario.priors[0].simulator;
  const auto next = [right](const auto& X, const auto& U, const auto& phi, MatrixView dX) {
    right->change(X, U, phi, dX);
    dX += X;
  };
  scenario.priors[0].simulator = system::make_simulator(scenario.priors[0].parameters, next);
  const Tried found = try_out(scenario);
  ASSERT_EQ(found.priors[0].notes.size(), 1u);
  EXPECT_NE(found.priors[0].notes[0].find("changes of state, not the next one?"), std::string::npos);
}

TEST(TryOut, APriorsRowsMustNotKnowTheirPlace) {
  const auto with_place = [](double weight) {
    return tried_with([=](const auto& X, const auto&, const auto&, MatrixView dX) {
             dX = X;
             for (Index i = 0; i < X.rows(); ++i) dX(i, 0) += weight * static_cast<double>(i);
           })
        .priors[0]
        .broken;
  };
  const std::string start = "predicts something else of the same rows in another batch (30 of 30 rows, rate by ";
  EXPECT_EQ(with_place(0.1).find(start), 0u) << with_place(0.1);
  EXPECT_EQ(with_place(1e-16), "") << "NumPy's last bits depend on the place, too";
}

TEST(TryOut, APriorsRowsMustNotKnowTheOthers) {
  const Tried found = tried_with([](const auto& X, const auto&, const auto&, MatrixView dX) {
    dX = X.rowwise() - X.colwise().mean();  // the same in any order
  });
  EXPECT_NE(found.priors[0].broken.find("in another batch"), std::string::npos) << found.priors[0].broken;
}

TEST(TryOut, ErrorsAreOfTheRowsThatSucceed) {
  const auto error_where = [](Index every) {
    const Tried found = tried_with([=](const auto& X, const auto&, const auto&, MatrixView dX) {
      dX.setConstant(1e6);
      for (Index i = 0; i < X.rows(); ++i)
        if (i % 4 < every) dX.row(i).setConstant(kNaN);
    });
    EXPECT_EQ(found.priors[0].failed, 15 * every);
    return found.priors[0].error;
  };
  EXPECT_NEAR(error_where(3)(0), 1e6, 100) << "a quarter of the rows";
  EXPECT_TRUE(error_where(4).array().isNaN().all());
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
  EXPECT_FALSE(tried(negative + "[[limit]]\nkeep = \"abs(rate) < 100\"\n").notes.empty());
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
  EXPECT_EQ(found.end, "the motor is hot");
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
  EXPECT_EQ(found.steps, 0);
  EXPECT_TRUE(found.end);
}

TEST(TryOut, NamesAPlantThatLosesItsWay) {
  const Tried found = tried(with("define.torque = \"u +", "define.torque = \"sqrt(-abs(rate)) +"));
  EXPECT_EQ(found.broken, std::vector<std::string>{"the plant comes to states that are not finite"});
  EXPECT_GT(found.priors[0].failed, 0);
}

}  // namespace
}  // namespace rehearse::robot_file
