#include "rehearse/check/input_scales.hpp"

#include <gtest/gtest.h>

#include "rehearse/policy/network.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::check {
namespace {

using Lines = std::vector<std::string>;

Task vessel() {
  Task task;
  task.states = {{"p", "Pa"}, {"a", "rad", StateKind::angle}};
  task.actions = {{"u", "", {-1, 1}}};
  task.dt_s = 0.1, task.horizon = 5;
  return task;
}

/// The notes on a pressure that gets from one number to another, seen divided by `scale`.
Lines notes(double low, double high, double scale) {
  const Task task = vessel();
  const auto policy = policy::make_mlp(
      {.features = task.feature_map(), .scale = Vector{{scale, 1, 1}}, .hidden = 2, .squash = {{{-1, 1}}, 1}});
  return notes_on_scales(task, *policy, Matrix{{low, 100}, {high, -100}});
}

TEST(NotesOnScales, NameWhatIsFarFromOne) {
  EXPECT_EQ(notes(-2000, 1000, 2000), Lines{});
  EXPECT_EQ(notes(-2000, 15000, 2000), Lines{}) << "and what is not far";
  EXPECT_EQ(
      notes(-1000, 30000, 1000),
      Lines{"p gets to 3e+04 Pa under random actions, 30 times its scale: policies see little but its sign; scale "
            "is to be about the largest value that it takes"});
  EXPECT_EQ(notes(-1e-6, 5e-7, 1),
            Lines{"p gets to 1e-06 Pa under random actions, 1e-06 times its scale: policies see next to nothing of it; "
                  "scale is to be about the largest value that it takes"});
  EXPECT_EQ(notes(0, 0, 1), Lines{}) << "what does not move says nothing";
}

TEST(NotesOnScales, NameAnOffset) {
  EXPECT_EQ(
      notes(101325, 103325, 2000),
      Lines{"p gets to 1.03e+05 Pa under random actions, 52 times its scale, and changes by 2e+03 alone: policies "
            "see nearly the same number all the time; count it from where the robot works, for instance from its "
            "start"});
}

TEST(NotesOnScales, AreOfPoliciesThatSeeStates) {
  const Task task = vessel();
  EXPECT_EQ(notes_on_scales(task, *policy::make_schedule(task), Matrix{{1e6, 0}}), Lines{});
}

}  // namespace
}  // namespace rehearse::check
