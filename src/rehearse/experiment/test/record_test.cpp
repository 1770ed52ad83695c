#include "rehearse/experiment/record.hpp"

#include <gtest/gtest.h>

namespace rehearse::experiment {
namespace {

TEST(Record, OfTrialsWithTheSameReturnTheFirstIsBest) {
  std::vector<TrialRecord> trials;
  for (const double value : {1.0, 3.0, -2.0, 3.0})
    trials.push_back({.trial = static_cast<Index>(trials.size()) + 1, .total_reward = value});
  EXPECT_EQ(best_trial(trials).trial, 2);
}

}  // namespace
}  // namespace rehearse::experiment
