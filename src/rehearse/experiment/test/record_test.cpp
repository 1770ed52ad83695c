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

TEST(Record, IsOfAToldRunWhereNoTrialWasDriven) {
  History history;
  EXPECT_FALSE(was_told(history));
  history.trials = {{.trial = 1, .file_checksum = "1f"}};
  EXPECT_TRUE(was_told(history));
  history.trials.push_back({.trial = 2});
  EXPECT_FALSE(was_told(history));
}

TEST(Record, ATrialThatWasCutShortIsNotTheBest) {
  std::vector<TrialRecord> trials{{.trial = 1, .total_reward = -1, .cut_short = true},
                                  {.trial = 2, .total_reward = -9},
                                  {.trial = 3, .total_reward = -8},
                                  {.trial = 4, .total_reward = -2, .cut_short = true}};
  EXPECT_EQ(best_trial(trials).trial, 3);
  trials = {trials[3], trials[0]};
  EXPECT_EQ(best_trial(trials).trial, 4) << "all were: the first";
}

}  // namespace
}  // namespace rehearse::experiment
