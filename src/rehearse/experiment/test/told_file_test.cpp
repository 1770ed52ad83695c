#include "rehearse/experiment/told_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

using fake::line_spec;

// A start that varies by 0.1 m, measured with some noise.
TEST(ToldFile, OfAStartFarFromTheTasksIsNoted) {
  const scenario::Scenario scenario = resolve(fake::catalogue(), line_spec(1)).scenario;
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
