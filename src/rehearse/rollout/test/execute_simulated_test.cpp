// A simulator in the place of the plant.
#include <stdexcept>

#include <gtest/gtest.h>

#include "cart.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::rollout {
namespace {

const Rng kStart({.seed = 5, .trial = 1, .purpose = Purpose::start_state});

TEST(ExecuteSimulated, ASimulatorInThePlaceOfThePlant) {
  const Task task = cart::task();
  const ParameterSpace space({{.name = "push", .unit = "1/kg", .value = 0.1}});
  const auto simulator = system::make_simulator(
      space, [](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
        dX.col(0) = phi(0) * U.col(0);
        dX.col(1) = 0.1 * X.col(0);
      });
  const Vector theta = cart::candidates(1), phi{{0.2}};
  const Episode episode = execute({simulator, phi}, *cart::policy(), theta, task, kStart);
  ASSERT_EQ(episode.steps(), 20);
  EXPECT_EQ(episode.states, episode.true_states);
  EXPECT_NE(episode.states(0, 0), 0) << "it starts as the task says";
  for (Index t = 0; t < 20; ++t) {
    EXPECT_DOUBLE_EQ(episode.states(t + 1, 0), episode.states(t, 0) + 0.2 * episode.actions(t, 0));
    EXPECT_DOUBLE_EQ(episode.states(t + 1, 1), episode.states(t, 1) + 0.1 * episode.states(t, 0));
  }
  EXPECT_EQ(episode.states, execute({simulator, phi}, *cart::policy(), theta, task, kStart).states);
}

TEST(ExecuteSimulated, AStepThatCannotBeSimulatedIsAFall) {
  Task task = cart::task(0);
  Index steps = 0;
  const auto simulator =
      system::make_simulator({}, [&](const ConstMatrixView&, const ConstMatrixView&, const Vector&, MatrixView dX) {
        if (steps++ == 3) throw std::runtime_error("lost");
        if (steps > 4)
          dX.setConstant(kNaN);
        else
          dX.setConstant(0.1);
      });
  const Episode episode = execute({simulator, Vector()}, *cart::policy(), cart::candidates(1), task, kStart);
  EXPECT_EQ(episode.states.rows(), 4);
  EXPECT_TRUE(episode.ended && episode.states.allFinite());
  EXPECT_EQ(episode.failure, "the state at step 4 is not finite");
  EXPECT_EQ(episode.charged, -0.5 * 17);
}

TEST(ExecuteSimulated, ASimulatorThatGrowsBeyondAllBoundsIsAFall) {
  const auto simulator =
      system::make_simulator({}, [](const ConstMatrixView& X, const ConstMatrixView&, const Vector&, MatrixView dX) {
        dX = 0.9 * X.array() + 1e10;  // by less than the state, so that no change is too large
      });
  const Episode episode = execute({simulator, Vector()}, *cart::policy(), cart::candidates(1), cart::task(), kStart);
  EXPECT_TRUE(episode.ended);
  EXPECT_EQ(episode.failure, "the state at step 8 is beyond ±1e+12");
}

}  // namespace
}  // namespace rehearse::rollout
