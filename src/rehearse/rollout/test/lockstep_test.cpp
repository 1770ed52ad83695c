#include "rehearse/rollout/lockstep.hpp"

#include <algorithm>
#include <ranges>

#include <gtest/gtest.h>

#include "cart_rollouts.hpp"

namespace rehearse::rollout {
namespace {

TEST(Lockstep, ATapeChangesNothingAndSaysWhoEarned) {
  Task task = cart::task();
  task.ended = each_state([](const ConstVectorView& x) { return x(1) > 1.15; });
  const cart::Model model(0.01, [](double, double position) { return position < 0.7; });
  const auto policy = cart::policy();
  const Simulation simulation{model, *policy, task, cart::kKey};
  const Matrix Theta = cart::candidates(40).transpose();
  LockstepMemory memory, other;
  Lockstep plain(simulation, 40, memory), taped(simulation, 40, other);
  for (Lockstep* chunk : {&plain, &taped}) chunk->set_rows(Theta, {3}), chunk->start();
  TapedStep tape;
  for (Index t = 0; t < task.horizon; ++t) {
    std::vector<bool> before;
    for (Index row = 0; row < 40; ++row) before.push_back(taped.alive(row));
    const Index failed = taped.failed();
    plain.step(t);
    taped.step(t, nullptr, &tape);
    ASSERT_EQ(plain.states(), taped.states());
    Index left_out = 0;
    for (Index row = 0; row < 40; ++row) {
      const auto i = static_cast<std::size_t>(row);
      EXPECT_EQ(tape.went_on[i] != 0, taped.alive(row));
      EXPECT_FALSE(tape.went_on[i] && !tape.earned[i]);
      left_out += before[i] && !tape.earned[i];
    }
    EXPECT_EQ(left_out, taped.failed() - failed) << "only a failure earns nothing";
  }
  EXPECT_EQ(plain.returns(), taped.returns());
  EXPECT_GT(taped.failed(), 3);
}

/// A cart that falls, breaks a limit, fails or goes on to the horizon; what a step costs knows the action before.
Task task_with_ends() {
  Task task = cart::task();
  task.ended = each_state([](const ConstVectorView& x) { return x(1) > 1.5; });
  task.limits = {{"speed", "", [](const Steps& steps, VectorView kept) {
                    kept = (steps.X_next.col(0).array() > -1).cast<double>();
                  }}};
  task.cost = [](const Steps& steps, VectorView cost) { cost = 0.1 * (steps.U - steps.U_before).col(0).cwiseAbs(); };
  return task;
}

TEST(Lockstep, DropsRowsThatHaveEndedAndChangesNoOther) {
  constexpr Index kRows = 40;
  const Task task = task_with_ends();
  const cart::Model model(
      0.01, [](double, double position) { return position < 0.7; }, Vector::Constant(2, 0.01));
  const auto policy = cart::policy();
  const Simulation simulation{model, *policy, task, cart::kKey};
  const Matrix Theta = cart::candidates(kRows).transpose();
  LockstepMemory memory, other;
  Lockstep whole(simulation, kRows, memory), dropping(simulation, kRows, other);
  Episodes all, fewer;
  for (Lockstep* chunk : {&whole, &dropping}) chunk->set_rows(Theta, {3}), chunk->start();
  all.begin(task, whole.states()), fewer.begin(task, dropping.states());
  Index rows = 0;
  for (Index t = 0; t < task.horizon; ++t) {
    whole.step(t, &all), dropping.step(t, &fewer);
    EXPECT_TRUE(dropping.drop_ended());
    rows = dropping.states().rows();
    const Index alive =
        std::ranges::count_if(std::views::iota(Index{0}, kRows), [&](Index row) { return whole.alive(row); });
    EXPECT_LE(rows - alive, kRows / 8) << "in step " << t;
  }
  EXPECT_GT(rows, 0);
  EXPECT_LT(rows, kRows / 2);
  EXPECT_EQ(whole.returns(), dropping.returns());
  EXPECT_EQ(whole.broken(), dropping.broken());
  EXPECT_GT(whole.broken().sum(), 0);
  EXPECT_EQ(whole.failed(), dropping.failed());
  EXPECT_GT(whole.failed(), 0);
  EXPECT_EQ(all.steps, fewer.steps);
  all.finish(task, whole.returns()), fewer.finish(task, dropping.returns());
  for (Index row = 0; row < kRows; ++row) {
    Episode expected, episode;
    all.copy(row, expected), fewer.copy(row, episode);
    EXPECT_EQ(expected.states, episode.states);
    EXPECT_EQ(expected.actions, episode.actions);
    EXPECT_EQ(expected.rewards, episode.rewards);
    EXPECT_EQ(expected.ended, episode.ended);
  }
}

TEST(Lockstep, SaysWhenNoRowIsAlive) {
  Task task = cart::task();
  task.ended = each_state([](const ConstVectorView&) { return true; });
  const cart::Model model;
  const auto policy = cart::policy();
  LockstepMemory memory;
  Lockstep chunk({model, *policy, task, cart::kKey}, 8, memory);
  chunk.set_rows(cart::candidates(8).transpose(), {}), chunk.start();
  EXPECT_TRUE(chunk.drop_ended());
  chunk.step(0);
  EXPECT_FALSE(chunk.drop_ended());
  EXPECT_EQ(chunk.returns().size(), 8);
}

TEST(Lockstep, DeviatesFromTheMeanAsOftenAsItIsTold) {
  Task task = cart::task();
  const cart::Model model(0.01);
  const auto policy = cart::policy();
  const Matrix Theta = cart::candidates(8).transpose();
  const auto first_step = [&](const SimulateOptions& options) {
    const Simulation simulation{model, *policy, task, cart::kKey, options};
    LockstepMemory memory;
    Lockstep chunk(simulation, 8, memory);
    chunk.set_rows(Theta, {3}), chunk.start(), chunk.step(0);
    return chunk.states();
  };
  const Matrix mean = first_step({.sample = false}), once = first_step({.noise_clip = 0}) - mean,
               thrice = first_step({.noise_clip = 0, .deviations = 3}) - mean;
  EXPECT_GT(once.cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((thrice - 3 * once).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace rehearse::rollout
