#include "rehearse/robots/hexapod/dart_simulator.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/robots/hexapod/state.hpp"
#include "rehearse/robots/hexapod/test/damaged.hpp"
#include "rehearse/testing/check_simulator.hpp"

namespace rehearse::robots::hexapod {
namespace {

/// Root mean square error of the joints' angles in a step of a walk, rad.
double error_of_joints(double lag_s, const Episode& walk) {
  const Index T = walk.steps();
  Matrix dX(T, kStateSize);
  make_dart_simulator(0.1, Joints::servos, lag_s)->change(walk.true_states.topRows(T), walk.actions, Vector{{-1}}, dX);
  const Matrix errors = walk.true_states.topRows(T) + dX - walk.true_states.bottomRows(T);
  return std::sqrt(errors.leftCols(kJoints).squaredNorm() / static_cast<double>(kJoints * T));
}

TEST(DartSimulator, APriorWhoseServosLagIsNearerToTheRobot) {
  const Episode walk = tripod_on({});
  const double perfect = error_of_joints(0, walk), lagging = error_of_joints(0.12, walk);
  EXPECT_LT(lagging, 0.6 * perfect);
  EXPECT_GT(error_of_joints(0.5, walk), 1.2 * lagging);
  Options options;
  options.servo_lag_s = 0.12;
  Matrix dX(1, kStateSize), expected(1, kStateSize);
  const Matrix X = rest().transpose(), U = Matrix::Constant(1, kJoints, 0.3);
  make(options).priors.front().simulator->change(X, U, Vector{{-1}}, dX);
  make_dart_simulator(0.1, Joints::servos, 0.12)->change(X, U, Vector{{-1}}, expected);
  EXPECT_EQ(dX, expected);
}

TEST(DartSimulator, APriorWhoseServosLagKeepsTheLaws) {
  const Episode walk = tripod_on({});
  const auto lagging = make_dart_simulator(0.1, Joints::servos, 0.12);
  for (const double missing : {-1.0, 2.0})
    for (const auto& broken : testing::check_simulator(*lagging, walk.true_states.middleRows(5, 6),
                                                       walk.actions.middleRows(5, 6), Vector{{missing}}))
      ADD_FAILURE() << broken;
}

}  // namespace
}  // namespace rehearse::robots::hexapod
