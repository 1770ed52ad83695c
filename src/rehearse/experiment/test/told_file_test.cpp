#include "rehearse/experiment/told_file.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

using fake::line_spec;

// A start that varies by 0.1 m, measured with some noise.
TEST(ToldFile, OfAStartFarFromTheTasksIsNoted) {
  scenario::Scenario scenario = resolve(fake::catalogue(), line_spec(1)).scenario;
  const auto notes_on_start = [&](double x) {
    std::string text = "time [s],x [m],v [m/s]\n";
    for (int t = 0; t <= 12; ++t) text += fmt::format("{},{},0\n", 0.1 * t, x + (t % 2 == 0 ? 0.01 : -0.01));
    const TrialRecord asked{.trial = 1, .policy = "line", .theta = Vector::Zero(2)};
    std::vector<std::string> notes = episode_of({"a.csv", text, ""}, scenario, asked, {}, {}).notes;
    std::erase_if(notes, [](const std::string& note) { return !note.starts_with("starts at"); });
    return notes;
  };
  EXPECT_EQ(notes_on_start(4), std::vector<std::string>{"starts at x = 4.01 m, the task at 1 m"});
  EXPECT_EQ(notes_on_start(0.5), std::vector<std::string>{});
  scenario.task.states[0].unit = "";
  EXPECT_EQ(notes_on_start(4), std::vector<std::string>{"starts at x = 4.01, the task at 1"});
}

/// A line's file of so many steps.
ToldFile file_of_steps(int steps) {
  std::string text = "time [s],x [m],v [m/s]\n";
  for (int t = 0; t <= steps; ++t) text += fmt::format("{},{},0.5\n", 0.1 * t, 1 + 0.05 * t);
  return {"a.csv", text, ""};
}

TEST(ToldFile, IsReadOnceUnlessItIsLongerThanATrial) {
  const scenario::Scenario scenario = resolve(fake::catalogue(), line_spec(1)).scenario;
  const TrialRecord asked{.trial = 1, .policy = "line", .theta = Vector::Zero(2)};
  for (const int steps : {12, 15}) {
    const ToldFile unread = file_of_steps(steps);
    ToldFile read = unread;
    read.whole = readable(unread, scenario.task);
    if (steps == 12) read.bytes.clear();  // as if nobody could read them again
    const ToldEpisode a = episode_of(unread, scenario, asked, {}, {}), b = episode_of(read, scenario, asked, {}, {});
    EXPECT_EQ(a.episode.states, b.episode.states) << steps;
    EXPECT_EQ(a.notes, b.notes) << steps;
    read.bytes.clear();
    EXPECT_EQ(logs_of({read}, scenario.task).at(0).episode.steps(), steps);
  }
}

TEST(ToldFile, ALogThatIsMostlyBeyondTheEndIsNoted) {
  Task task = fake::line_task();
  task.ended = each_state([](const ConstVectorView& x) { return std::abs(x(0)) > 2; });
  task.limits = {{.name = "end", .text = "x < 3 m", .holds = [](const Steps& steps, VectorView holds) {
                    holds = (steps.X_next.col(0).array() < 3).cast<double>().matrix();
                  }}};
  Episode log{.states = Matrix::Zero(13, 1), .actions = Matrix::Zero(12, 1), .rewards = Vector::Zero(12)};
  log.states.col(0).tail(3).setConstant(2.5);
  log.true_states = log.states;
  EXPECT_EQ(notes_on_ends(log, task), std::vector<std::string>{}) << "a quarter of the steps";
  log.true_states.col(0).tail(4).setConstant(4);
  EXPECT_EQ(notes_on_ends(log, task),
            (std::vector<std::string>{"`ended` holds in 4 of 12 steps: is a column in another unit than it says?",
                                      "the limit end is broken in 4 of 12 steps: is a column in another unit than it "
                                      "says?"}));
}

// Numbers of eight digits, as loops write them.
TEST(ToldFile, FollowsThePolicyWhoseActionsItHas) {
  const scenario::Scenario scenario = resolve(fake::catalogue(), line_spec(1)).scenario;
  const TrialRecord asked{.trial = 1, .policy = "line", .theta = Vector{{-0.5, 0.1}}};
  const auto follows = [&](double sign) {
    std::string text = "time [s],x [m],v [m/s]\n";
    for (int t = 0; t <= 12; ++t) {
      const double x = std::cos(0.3 * t);
      text += fmt::format("{:.8g},{:.8g},{:.8g}\n", 0.1 * t, x, sign * (-0.5 * x + 0.1));
    }
    const auto read = readable({"a.csv", text, ""}, scenario.task);
    EXPECT_FALSE(follows_policy(*read, scenario, asked)) << "which tells a file that was told before from a new trial";
    return may_follow_policy(*read, scenario, asked);
  };
  EXPECT_TRUE(follows(1));
  EXPECT_FALSE(follows(-1));
}

TEST(ToldFile, RepeatsAnEpisodeUpToItsEnd) {
  Episode read{.states = Matrix::Random(6, 2), .actions = Matrix::Random(5, 1), .rewards = Vector::Zero(5)};
  read.true_states = read.states;
  Episode kept = read.part(0, 3);
  EXPECT_TRUE(repeats(read, read, 5));
  EXPECT_TRUE(repeats(read, kept, 3)) << "no more were taken";
  EXPECT_FALSE(repeats(read, kept, 5)) << "it is longer";
  EXPECT_FALSE(repeats(kept, read, 5)) << "it is shorter";
  kept.ended = true;
  EXPECT_TRUE(repeats(read, kept, 5)) << "steps after a fall are left out";
  kept.actions(1, 0) += 1e-9;
  EXPECT_FALSE(repeats(read, kept, 5));
  EXPECT_FALSE(repeats(read, read.part(0, 0), 5)) << "it says nothing";
}

TEST(ToldFile, DoesNotGoOnAfterTheHorizon) {
  Task task = fake::line_task();
  Episode read{.states = Matrix::Zero(task.horizon + 4, task.state_size()),
               .actions = Matrix::Zero(task.horizon + 3, task.action_size()),
               .rewards = Vector::Zero(task.horizon + 3)};
  read.true_states = read.states;
  EXPECT_FALSE(goes_on_after(read, read.part(0, task.horizon), task)) << "it was told as a whole";
  Episode stopped = read.part(0, 2);
  stopped.ended = true;
  EXPECT_TRUE(goes_on_after(read, stopped, task));
}

}  // namespace
}  // namespace rehearse::experiment
