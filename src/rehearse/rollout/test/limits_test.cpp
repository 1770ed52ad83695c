// Limits end episodes in the same way on the plant and in models.

#include <gtest/gtest.h>

#include "cart_rollouts.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::rollout {
namespace {

using cart::kKey, cart::kUnclipped, cart::Noise, cart::noise_of, cart::simulate_cart, cart::start_of;

Limit above(Index state, double low, const char* name) {
  const auto holds = [=](const Steps& steps, VectorView kept) {
    kept = (steps.X_next.col(state).array() > low).cast<double>();
  };
  return {name, "", holds, 0.05};
}

Limit never_judged() {
  return {"nan", "", [](const Steps&, VectorView kept) { kept.setConstant(std::nan("")); }};
}

/// The first step (from 0) that breaks position > 0.9 or velocity > −0.4; T: none.
Index first_break(const Matrix& states) {
  for (Index t = 1; t < states.rows(); ++t)
    if (!(states(t, 1) > 0.9) || !(states(t, 0) > -0.4)) return t - 1;
  return states.rows() - 1;
}

Task limited_cart() {
  Task task = cart::task();
  task.limits = {above(1, 0.9, "place"), above(0, -0.4, "speed")};
  return task;
}

TEST(Limits, EndSimulatedEpisodesAtTheFloor) {
  const Task task = limited_cart();
  const Matrix Theta = cart::candidates(50);
  const Simulated simulated = simulate_cart(task, Theta, 2, kUnclipped, cart::Model(0.001));
  ASSERT_EQ(simulated.broken.size(), 2u);
  Index place = 0, speed = 0, kept = 0;
  for (Index j = 0; j < Theta.cols(); ++j)
    for (Index p = 0; p < 2; ++p) {
      const Noise noise = noise_of(task, static_cast<std::uint64_t>(j), static_cast<std::uint64_t>(p));
      const auto hand = cart::by_hand(task, Theta.col(j), start_of(task, noise), noise.steps, std::sqrt(0.001));
      const Index T = task.horizon, t = first_break(hand.states);
      double expected = 0;
      for (Index s = 1; s <= std::min(t + 1, T); ++s) expected += std::exp(-hand.states(s, 1) * hand.states(s, 1));
      expected += static_cast<double>(std::max<Index>(0, T - 1 - t)) * task.reward_floor;
      EXPECT_NEAR(simulated.returns(p, j), expected, 1e-12);
      const double left = static_cast<double>(T - t) / static_cast<double>(T);
      const bool at_place = t < T && !(hand.states(t + 1, 1) > 0.9),
                 at_speed = t < T && !(hand.states(t + 1, 0) > -0.4);
      EXPECT_EQ(simulated.broken[0](p, j), at_place ? left : 0);
      EXPECT_EQ(simulated.broken[1](p, j), at_speed ? left : 0);
      place += at_place, speed += at_speed, kept += t == T;
    }
  EXPECT_GT(std::min({place, speed, kept}), 5) << "all of it happens";
  EXPECT_EQ(simulated.failed, 0);
}

TEST(Limits, AreBrokenByWhatCannotBeJudged) {
  Task task = cart::task();
  task.limits = {never_judged()};
  const Simulated simulated = simulate_cart(task, cart::candidates(3), 1);
  EXPECT_EQ(simulated.broken[0], Matrix::Ones(1, 3)) << "in the first step";
}

TEST(Limits, AreBrokenByWhatCannotBeSimulated) {
  Task task = cart::task();
  task.limits = {above(1, -1e9, "place")};
  Index steps = 0;
  const auto bad = [&](double, double) { return ++steps > 3 * 5; };  // in the sixth step, for three candidates
  const Simulated simulated = simulate_cart(task, cart::candidates(3), 1, kUnclipped, cart::Model(0, bad));
  EXPECT_EQ(simulated.failed, 3);
  EXPECT_EQ(simulated.broken[0], Matrix::Constant(1, 3, 15.0 / 20)) << "and the earlier, the worse";
}

TEST(Limits, ThatAreKeptChangeNothing) {
  Task task = cart::task();
  const Simulated without = simulate_cart(task, cart::candidates(5), 3, kUnclipped, cart::Model(0.01));
  EXPECT_TRUE(without.broken.empty());
  task.limits = {above(1, -1e9, "place")};
  const Simulated with = simulate_cart(task, cart::candidates(5), 3, kUnclipped, cart::Model(0.01));
  EXPECT_EQ(with.returns, without.returns);
  EXPECT_EQ(with.broken[0], Matrix::Zero(3, 5));
}

TEST(Limits, EndEpisodesOnThePlant) {
  const Task task = limited_cart();
  const auto motion = [](const Vector& x, const Vector& u) -> Vector { return x + Vector{{0.1 * u(0), 0.1 * x(0)}}; };
  const auto plant = system::make_simulated_plant(motion, {task.start_mean, Vector::Zero(2), {}});
  const Matrix Theta = cart::candidates(50);
  bool broke = false;
  for (Index j = 0; j < Theta.cols(); ++j) {
    const Episode episode = execute(*plant, *cart::policy(), Theta.col(j), task, Rng({.seed = 5}));
    const Index t = first_break(episode.true_states);
    EXPECT_EQ(episode.ended, t < episode.true_states.rows() - 1);
    EXPECT_EQ(episode.broken_limits.empty(), !episode.ended);
    EXPECT_TRUE(episode.failure.empty());
    if (!episode.ended) continue;
    broke = true;
    EXPECT_EQ(t, episode.steps() - 1) << "the step that breaks it is the last";
    EXPECT_EQ(episode.charged, static_cast<double>(task.horizon - episode.steps()) * task.reward_floor);
    EXPECT_EQ(episode.broken_limits.front(), episode.true_states(t + 1, 1) > 0.9 ? "speed" : "place");
  }
  EXPECT_TRUE(broke);
}

TEST(Limits, EndRecordedEpisodes) {
  Task task = cart::task();
  task.limits = {above(0, 1e9, "speed")};
  Episodes episodes;
  const cart::Model model;
  simulate_episodes({model, *cart::policy(), task, kKey}, cart::candidates(1).transpose(), {}, episodes);
  EXPECT_EQ(episodes.steps, std::vector<Index>{1});
  EXPECT_TRUE(episodes.ended[0]);
}

/// Actions, those one step before, and times, of each step that a limit was asked about.
struct Asked {
  std::vector<double> actions, before, times;

  Limit limit() {
    return {"asked", "", [this](const Steps& steps, VectorView kept) {
              actions.push_back(steps.U(0, 0));
              before.push_back(steps.U_before(0, 0));
              times.push_back(steps.time_s);
              kept.setOnes();
            }};
  }

  void expect_all_of_a_step(const Task& task) const {
    ASSERT_EQ(times.size(), static_cast<std::size_t>(task.horizon));
    for (std::size_t t = 0; t < times.size(); ++t) {
      EXPECT_EQ(before[t], t > 0 ? actions[t - 1] : 0) << t;
      EXPECT_EQ(times[t], static_cast<double>(t) * task.dt_s);
    }
  }
};

TEST(Limits, SeeActionsBeforeAndTime) {
  Task task = cart::task();
  Asked simulated, executed;
  task.limits = {simulated.limit()};
  Episodes episodes;
  const cart::Model model;
  simulate_episodes({model, *cart::policy(), task, kKey}, cart::candidates(1).transpose(), {}, episodes);
  simulated.expect_all_of_a_step(task);
  task.limits = {executed.limit()};
  const auto motion = [](const Vector& x, const Vector& u) -> Vector { return x + Vector{{0.1 * u(0), 0.1 * x(0)}}; };
  const auto plant = system::make_simulated_plant(motion, {task.start_mean, Vector::Zero(2), {}});
  execute(*plant, *cart::policy(), cart::candidates(1), task, Rng({.seed = 5}));
  executed.expect_all_of_a_step(task);
}

}  // namespace
}  // namespace rehearse::rollout
