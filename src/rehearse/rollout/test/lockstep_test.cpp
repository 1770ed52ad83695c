#include "rehearse/rollout/lockstep.hpp"

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
