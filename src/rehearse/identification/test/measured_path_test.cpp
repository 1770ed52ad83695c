#include "rehearse/identification/smoothing/measured_path.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/swing.hpp"

namespace rehearse::identification {
namespace {

Episode episode(Index steps, double start) {
  Episode episode{.states = Matrix(steps + 1, 1),
                  .true_states = {},
                  .actions = Matrix::Zero(steps, 1),
                  .rewards = Vector::Zero(steps)};
  for (Index t = 0; t <= steps; ++t) episode.states(t, 0) = start + 0.1 * static_cast<double>(t);
  return episode;
}

Dataset episodes() {
  Dataset data;
  data.append(episode(3, 0));
  data.append(episode(4, 10));
  return data;
}

TEST(MeasuredPath, StepsOfAnEpisodeShareMeasurements) {
  const Dataset data = episodes();
  const std::vector<Block> blocks = blocks_of(data, 100);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].rows, 7);
  EXPECT_EQ(blocks[0].measurements, 9);
  EXPECT_EQ(blocks[0].before, (std::vector<Index>{0, 1, 2, 4, 5, 6, 7}));
  const Matrix Y = measurements_of(data, blocks);
  EXPECT_NEAR(Y(3, 0), 0.3, 1e-12);
  EXPECT_NEAR(Y(4, 0), 10, 1e-12);
}

TEST(MeasuredPath, BlocksHaveMeasurementsOfTheirOwn) {
  const Dataset data = episodes();
  const std::vector<Block> blocks = blocks_of(data, 2);
  ASSERT_EQ(blocks.size(), 4u);
  EXPECT_EQ(blocks[1].first, 2);
  EXPECT_EQ(blocks[1].before, (std::vector<Index>{0, 2}));  // of one episode each
  EXPECT_EQ(blocks[2].before, (std::vector<Index>{0, 1}));
  EXPECT_EQ(blocks[3].rows, 1);
  EXPECT_EQ(measurements_of(data, blocks).rows(), 3 + 4 + 3 + 2);
}

TEST(MeasuredPath, StepsMayHaveMeasurementsOfTheirOwn) {
  const Dataset data = episodes();
  const std::vector<Block> blocks = blocks_of(data, 4, Measurements::own);
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].before, (std::vector<Index>{0, 2, 4, 6}));
  const Matrix Y = measurements_of(data, blocks);
  EXPECT_EQ(Y.rows(), 14);
  EXPECT_NEAR(Y(1, 0), Y(2, 0), 1e-12);
}

TEST(MeasuredPath, IsTheDataAgain) {
  const Dataset steps = swing::data(5, 1), data = episodes();
  for (const Dataset& all : {data, steps}) {  // the latter: each step on its own
    const std::vector<Block> blocks = blocks_of(all, 3);
    const Dataset path = path_of(measurements_of(all, blocks), all, blocks);
    EXPECT_LT((path.states - all.states).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((path.changes - all.changes).cwiseAbs().maxCoeff(), 1e-12);
  }
  EXPECT_TRUE(blocks_of({}, 3).empty());
}

}  // namespace
}  // namespace rehearse::identification
