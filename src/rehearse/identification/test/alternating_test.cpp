#include "rehearse/identification/alternating.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "learn_swing.hpp"
#include "pendubot_episode.hpp"

namespace rehearse::identification {
namespace {

using swing::learn_swing;

// The alternating search has many chances to stop lower than the plain one; seed 1, with and without noise.
TEST(Alternating, FindsNoLowerScoreThanTheNestedSearch) {
  for (const double noise : {0.0, 0.01}) {
    robots::pendubot::Options options;
    options.ode.measurement_noise = noise;
    const scenario::Scenario s = robots::pendubot::make(options);
    const Dataset data = one_episode(s, 1);
    for (const auto& guess : s.priors) {
      if (guess.name != "misleading" && guess.name != "partial") continue;
      const prior::Prior prior{guess.name, guess.simulator, guess.parameters};
      GpMi by_turns, nested;
      nested.search = PhiSearch::nested;
      by_turns.gp.smooth = nested.gp.smooth = false;
      const auto score = [&](const GpMi& kind) {
        return *learn({data, s.task.feature_map(), s.task.kinematics(), &prior}, kind, {}, serial_evaluator()).score;
      };
      EXPECT_GT(score(by_turns), score(nested) - 0.01) << guess.name << " noise " << noise;
    }
  }
}

/// The swing with a wind that the prior does not know of, so that kernels and φ have something to settle.
Dataset windy(Index n) {
  Dataset data = swing::data(n, 1);
  data.changes.col(0).array() += 0.2 * (data.states.col(1).array() * 2).sin() * data.states.col(0).array().tanh();
  return data;
}

// 200 rows are searched on a part of 67 of them first, 500 on two parts, and these go on with one fit alone.
TEST(Alternating, OnManyRowsIsNoWorseThanNestedAndTheSameForAnyNumberOfThreads) {
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const auto threads = make_thread_evaluator(2);
  for (const Index rows : {200, 500}) {
    const Dataset data = windy(rows);
    GpMi nested;
    nested.search = PhiSearch::nested;
    const Learned learned = learn_swing(data, GpMi{}, &prior);
    if (rows == 200) {  // else it takes long
      EXPECT_GT(*learned.score, *learn_swing(data, nested, &prior).score - 0.01);
    }
    const Learned same = learn_swing(data, GpMi{}, &prior, {}, *threads);
    EXPECT_EQ(same.state.phi, learned.state.phi);
    EXPECT_EQ(same.score, learned.score);
  }
}

// Hurried, what the parts lead to is worse than what it is given.
TEST(Alternating, IsNeverWorseThanWhereItStarts) {
  const Dataset data = windy(200);
  const prior::Prior prior = swing::prior({swing::length(), swing::friction()});
  const Learned first = learn_swing(data, GpMi{}, &prior);
  GpMi hurried;
  hurried.gp.fit.bfgs.max_evaluations = 2;
  EXPECT_GE(*learn_swing(data, hurried, &prior, first.state).score, *first.score - 1e-6);
}

}  // namespace
}  // namespace rehearse::identification
