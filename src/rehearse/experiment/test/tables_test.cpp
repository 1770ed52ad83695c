#include "rehearse/experiment/tables.hpp"

#include <gtest/gtest.h>

#include "fake.hpp"

namespace rehearse::experiment {
namespace {

// Two samples, of which one ends; moments that are lost after the first step.
TEST(PredictionCsv, HasTheMomentsBesideTheSamples) {
  Task task = fake::line_task();
  task.horizon = 2;
  rollout::Recorded recorded{.states = {Matrix{{1}, {1}}, Matrix{{1}, {4}}, Matrix{{3}, {kNaN}}},
                             .rewards = Matrix{{1, 2}, {3, 2}},
                             .returns = Vector{{3, 5}}};
  const std::string samples = prediction_csv(task, recorded);
  EXPECT_EQ(samples,
            "time [s],particles,x mean [m],x 5% [m],x 25% [m],x 50% [m],x 75% [m],x 95% [m]\n"
            "0,2,1,1,1,1,1,1\n0.1,2,2.5,1.15,1.75,2.5,3.25,3.8499999999999996\n0.2,1,3,3,3,3,3,3\n");

  recorded.states[1](1) = 1;
  ExpectedEpisode moments = ExpectedEpisode::unknown(2, 1);
  moments.states.topRows(2) << 1, 1.5;
  moments.state_deviations.topRows(2) << 0, 0.25;
  moments.rewards(0) = 2.5;
  moments.reward_deviations(0) = 0.5;
  EXPECT_EQ(prediction_csv(task, recorded, &moments),
            "time [s],particles,x mean [m],x 5% [m],x 25% [m],x 50% [m],x 75% [m],x 95% [m],x std [m],"
            "x moment mean [m],x moment std [m],reward mean,reward std,reward moment mean,reward moment std\n"
            "0,2,1,1,1,1,1,1,0,1,0,,,,\n"
            "0.1,2,1,1,1,1,1,1,0,1.5,0.25,2,1.4142135623730951,2.5,0.5\n"
            "0.2,1,3,3,3,3,3,3,,,,2,0,,\n");
}

TEST(TrialsCsv, SaysWhichTrialsWereCutShortWhereOneWas) {
  std::vector<TrialRecord> trials{{.trial = 1, .interaction_s = 1, .total_reward = -3, .solved = false},
                                  {.trial = 2, .interaction_s = 1.5, .total_reward = -1}};
  EXPECT_EQ(trials_csv(trials, {}, false).find("cut_short"), std::string::npos);
  trials[1].cut_short = true;
  EXPECT_EQ(trials_csv(trials, {"m"}, false),
            "trial,interaction_s,return,solved,predicted_return,rollouts,failed_rollouts,log_evidence,phi.m,phi.m.low,"
            "phi.m.high,cut_short\n1,1,-3,0,,0,0,,,,,0\n2,1.5,-1,,,0,0,,,,,1\n");
}

TEST(LimitsCsv, HasARowATrialAndLimit) {
  TrialRecord random{.trial = 1}, second{.trial = 2};
  random.limits = {{.limit = "track", .allowed = 0.05, .broken = true}};
  second.limits = {{.limit = "track", .allowed = 0.05, .predicted = 0.01, .interval = {0, 0.03}}};
  EXPECT_EQ(limits_csv({random, second}),
            "trial,limit,allowed_risk,predicted_risk,low,high,broken\n"
            "1,track,0.05,,,,1\n2,track,0.05,0.01,0,0.03,0\n");
}

}  // namespace
}  // namespace rehearse::experiment
