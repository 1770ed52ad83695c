#include "rehearse/study/robot_alone.hpp"

#include <gtest/gtest.h>

#include "rehearse/study/hints.hpp"
#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

/// The swing whose motor is known to be so many steps late.
Task late_task(Index steps) {
  Task task = swinging_task();
  task.actions[0].actuation.delay_s = static_cast<double>(steps) * task.dt_s;
  return with_memory(task);
}

/// A log of the swing as a record of that task: its actions are commands, which acted so many steps later, or `more`.
Episode commanded(const Log& log, Index steps, Index more) {
  const Episode& moved = log.episode;
  const Index T = moved.steps() - steps - more;
  Episode episode{.states = Matrix::Zero(T + 1, moved.states.cols() + steps),
                  .actions = moved.actions.middleRows(steps + more, T),
                  .rewards = Vector::Zero(T)};
  episode.states.leftCols(moved.states.cols()) = moved.states.topRows(T + 1);
  for (Index back = 1; back <= steps; ++back)  // the commands that are still on their way
    for (Index t = 0; t <= T; ++t)
      episode.states(t, moved.states.cols() + back - 1) = moved.actions(t + steps + more - back, 0);
  episode.true_states = episode.states;
  return episode;
}

TEST(RobotAlone, ActionsAreThoseThatMovedIt) {
  const Task task = late_task(2);
  const Log log = swinging_log(1, 0);
  const Episode alone = robot_alone(commanded(log, 2, 0), task.actuators());
  EXPECT_EQ(alone.states.cols(), 2);
  EXPECT_TRUE(alone.actions.isApprox(log.episode.actions.topRows(alone.steps())));
  EXPECT_EQ(robot_alone(task).state_size(), 2);
  EXPECT_EQ(robot_alone(task).actuators().memory(), 0);
}

TEST(RobotAlone, AFurtherDelayIsSeenBehindOneThatIsKnown) {
  const Task task = late_task(2);
  const auto hints = [&](Index more) {
    std::vector<Episode> logs;
    for (std::uint64_t i = 1; i <= 3; ++i)
      logs.push_back(robot_alone(commanded(swinging_log(i, 0), 2, more), task.actuators()));
    return find_hints(logs, robot_alone(task), swinging_prior(), {}, serial_evaluator());
  };
  EXPECT_TRUE(hints(0).empty());
  ASSERT_FALSE(hints(6).empty());
  EXPECT_NEAR(hints(6)[0].delay_s, 0.12, 0.021);
}

}  // namespace
}  // namespace rehearse::study
