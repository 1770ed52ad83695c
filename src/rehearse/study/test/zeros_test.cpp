#include "rehearse/study/zeros.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

TEST(Zeros, AndParametersAreFoundTogether) {
  const prior::Prior prior = swinging_prior();
  const std::vector<Episode> logs = {swinging_log(1, 0.1).episode, swinging_log(2, -0.05).episode};
  const Zeros zeros = find_zeros(logs, {prior, {1}, 0.3, 10}, serial_evaluator());
  EXPECT_NEAR(zeros.offsets(0, 1), 0.1, 0.01);
  EXPECT_NEAR(zeros.offsets(1, 1), -0.05, 0.01);
  EXPECT_EQ(zeros.offsets.col(0), Vector::Zero(2));
  EXPECT_NEAR(zeros.phi(0), 6, 0.1);
  ASSERT_TRUE(zeros.posterior);
  const std::vector<Interval> intervals = zeros.posterior->intervals();
  EXPECT_TRUE(intervals[0].low < 6 && 6 < intervals[0].high);
  EXPECT_TRUE(intervals[1].low < 0.5 && 0.5 < intervals[1].high);
  EXPECT_LT(zeros.deviations(0, 1), 0.05);
}

TEST(Zeros, OutliersMoveNothing) {
  const prior::Prior prior = swinging_prior();
  Episode log = swinging_log(3, 0.1).episode;
  for (Index t = 50; t < 400; t += 50) log.states(t, 0) = 25;
  EXPECT_NEAR(find_zeros({log}, {prior, {1}, 0.3, 10}, serial_evaluator()).offsets(0, 1), 0.1, 0.02);
}

TEST(Zeros, AParameterThatWantsOutOfItsBoxIsKnown) {
  const ParameterSpace space({Parameter::continuous("weight", 2, {1, 3}), Parameter::fixed("damping", 0.5)});
  const prior::Prior prior{"guess", system::make_simulator(space, swing), space};
  const Zeros zeros = find_zeros({swinging_log(1, 0).episode}, {prior, {}, 0.3, 10}, serial_evaluator());
  EXPECT_NEAR(zeros.closest_phi(0), 3, 1e-3) << "6 is true";
}

TEST(Zeros, ShortLogsAreRefused) {
  const prior::Prior prior = swinging_prior();
  EXPECT_THROW(find_zeros({swinging_log(3, 0).episode}, {prior, {1}, 0.3, 1000}, serial_evaluator()), InvalidInput);
}

}  // namespace
}  // namespace rehearse::study
