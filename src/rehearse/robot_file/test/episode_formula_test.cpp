#include "rehearse/robot_file/episode_formula.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "example.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/task.hpp"

namespace rehearse::robot_file {
namespace {

std::string with_episode(const std::string& formula) {
  return example::with("width = 0.5", "width = 0.5\nepisode = \"" + formula + "\"");
}

double earned(const std::string& formula) {
  Episode episode;
  episode.true_states = Matrix{{3, 0.5}, {-6, 1}, {1, 2}};
  episode.states = Matrix::Zero(3, 2);
  episode.actions = Matrix::Zero(2, 1);
  return make_task(read(with_episode(formula), "swing.toml", example::no_files)).episode_reward(episode);
}

TEST(EpisodeFormula, IsOfTheEndTheLargestTheSmallestAndTheMean) {
  EXPECT_DOUBLE_EQ(earned("rate"), 1);
  EXPECT_DOUBLE_EQ(earned("-2 * rate_max + 10 * rate_min"), -66);
  EXPECT_DOUBLE_EQ(earned("3 * rate_mean"), -2);
}

TEST(EpisodeFormula, KnowsDefinitionsOfStates) {
  EXPECT_NEAR(earned("height"), std::cos(2.0), 1e-15);
  EXPECT_NEAR(earned("height_max"), std::cos(0.5), 1e-15) << "of each state, not of the largest angle";
}

TEST(EpisodeFormula, OfAStepIsRefused) {
  for (const char* name : {"u", "u_max", "u_before", "time"}) {
    const std::string complaint = example::complaint_of(with_episode(name));
    EXPECT_NE(complaint.find("reward.episode: '" + std::string(name) + "' is "), std::string::npos) << complaint;
  }
  EXPECT_NE(example::complaint_of(with_episode("rate_mx")).find("did you mean 'rate_max'"), std::string::npos);
}

TEST(EpisodeFormula, IsNotThereWithoutOne) {
  EXPECT_FALSE(make_task(read(example::kSwing, "swing.toml", example::no_files)).episode_reward);
}

}  // namespace
}  // namespace rehearse::robot_file
