#include "rehearse/identification/smoothing/transition_slopes.hpp"

#include <gtest/gtest.h>

#include "rehearse/dynamics/test/swing.hpp"
#include "rehearse/identification/learn.hpp"

namespace rehearse::identification {
namespace {

TEST(TransitionSlopes, AreThoseOfTheNextState) {
  const prior::Prior prior = swing::prior_at(swing::kTruth);
  const Dataset rows = swing::data(20, 1);
  const Learned learned = learn({rows, swing::features(), {}, &prior}, FixedPrior{}, {}, serial_evaluator());
  const std::vector<Matrix> slopes = transition_slopes(*learned.model, rows);
  Matrix states = rows.states, mean(20, 2), moved(20, 2);
  learned.model->predict_mean(states, rows.actions, mean);
  states.col(1).array() += 1e-5;
  learned.model->predict_mean(states, rows.actions, moved);
  Matrix expected = (moved - mean) / 1e-5;
  expected.col(1).array() += 1;
  EXPECT_LT((slopes[1] - expected).cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace rehearse::identification
