#include "rehearse/robot_file/details.hpp"

#include <gtest/gtest.h>

#include "example.hpp"

namespace rehearse::robot_file {
namespace {

using example::kSwing, example::with;
using Lines = std::vector<std::string>;

scenario::Details details(const std::string& text) { return builder(text, "swing.toml", example::no_files)->details(); }

TEST(Details, SayWhatTheFileSays) {
  const scenario::Details found = details(kSwing);
  EXPECT_EQ(found.reward, (Lines{"distance: 1 - height, sin(angle); width 0.5", "floor 0"}));
  EXPECT_EQ(found.ended, "");
  EXPECT_EQ(found.plant, (Lines{"dynamics pendulum, equations", "m = 1, l = 0.5 m", "measured without noise"}));
  EXPECT_EQ(found.priors, (Lines{"dynamics pendulum, equations"}));
}

TEST(Details, OfAFormulaWithACostAndAnEnd) {
  std::string text = with("distance = [\"1 - height\", \"sin(angle)\"]\nwidth = 0.5",
                          "formula = \"-rate\"\ncost = \"0.1 * u^2\"\nepisode = \"angle_max\"\nfloor = -2");
  const std::string horizon = "horizon = 20";
  text.replace(text.find(horizon), horizon.size(), horizon + "\nended = \"angle > 9\"");
  EXPECT_EQ(details(text).reward,
            (Lines{"formula: -rate", "cost: 0.1 * u^2", "of the whole episode: angle_max", "floor -2"}));
  EXPECT_EQ(details(text).ended, "angle > 9");
  text.replace(text.find("floor = -2"), 10, "width = 0.5");
  EXPECT_EQ(details(text).reward.front(), "formula: -rate; width 0.5 is of distances, so it has no effect");
}

TEST(Details, NameProgramsAndNoise) {
  std::string text = with("[plant]", "[plant]\nmeasurement_noise = { rate = 0.01 }") +
                     "dynamics = \"rig\"\n[dynamics.rig]\nprogram = [\"sh\", \"-c\", \"cat\"]\nparameters.m = 1\n";
  EXPECT_EQ(details(text).plant.back(), "measured with noise: rate ± 0.01");
  EXPECT_EQ(details(text).priors, (Lines{"dynamics rig, the program 'sh -c cat'"}));
}

}  // namespace
}  // namespace rehearse::robot_file
