#include "rehearse/robots/hexapod/mujoco_plant.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/robots/hexapod/dart_simulator.hpp"
#include "rehearse/robots/hexapod/state.hpp"
#include "rehearse/robots/hexapod/test/damaged.hpp"
#include "rehearse/testing/check_plant.hpp"

namespace rehearse::robots::hexapod {
namespace {

// The mean of 40 numbers with std 0.002 (0.02) is beyond 4 standard errors in 6e-5 of cases, their std beyond 1.5 times
// that in 1e-4; 6 of each: false alarm below 1e-3, seed 1.
TEST(MujocoPlant, AMissingLegIsMeasuredWithTheNoiseOfTheOthers) {
  const Episode walk = tripod_on(without(Leg::mid_left));
  ASSERT_EQ(walk.steps(), 40);
  for (const auto& [first, noise] : {std::pair(kAngles, 0.002), std::pair(kSpeeds, 0.02)})
    for (Index joint = 3; joint < 6; ++joint) {
      const Vector readings = walk.states.col(first + joint).tail(40);
      EXPECT_LT(std::abs(readings.mean()), 4 * noise / std::sqrt(40));
      EXPECT_NEAR(std::sqrt(readings.squaredNorm() / 40), noise, noise / 2);
      EXPECT_TRUE(walk.true_states.col(first + joint).isZero(0));
    }
}

/// Root mean square error, rad a step, of the prior without that leg in the trunk's rotation of a walk, given the
/// joints' positions.
double unexplained(const Episode& walk, double missing) {
  static const auto simulator = make_dart_simulator(0.1, Joints::driven);
  const Index T = walk.steps();
  Matrix dX(T, kStateSize);
  simulator->change(walk.true_states.topRows(T), walk.true_states.block(1, kAngles, T, kJoints), Vector{{missing}}, dX);
  const Matrix errors = walk.true_states.topRows(T) + dX - walk.true_states.bottomRows(T);
  return std::sqrt(errors.middleCols(kRotation, 3).squaredNorm() / static_cast<double>(3 * T));
}

/// The value of missing_leg that explains most.
double blamed(const Episode& walk) {
  Vector left(1 + kLegs);
  for (Index leg = -1; leg < kLegs; ++leg) left(1 + leg) = unexplained(walk, static_cast<double>(leg));
  Index best = 0;
  left.minCoeff(&best);
  return static_cast<double>(best) - 1;
}

TEST(MujocoPlant, AnyMissingLegIsTheOneThatExplainsTheWalk) {
  EXPECT_EQ(blamed(tripod_on({})), -1);
  for (Index leg = 0; leg < kLegs; ++leg) {
    const Episode walk = tripod_on(without(static_cast<Leg>(leg + 1)));
    EXPECT_EQ(blamed(walk), leg);
    EXPECT_LT(unexplained(walk, static_cast<double>(leg)), 0.04) << kLegNames[static_cast<std::size_t>(leg)];
  }
}

TEST(MujocoPlant, ServosThatFailAreNoMissingLeg) {
  for (const Damage kind : {Damage::blocked, Damage::weak})
    for (const Options::Joint joint : {Options::Joint::all, Options::Joint::femur}) {
      const Episode walk = tripod_on(hurt(Leg::rear_left, kind, joint));
      EXPECT_EQ(blamed(walk), -1);
      EXPECT_LT(unexplained(walk, -1), 0.02) << "what the servos did explains the walk";
    }
}

TEST(MujocoPlant, NoParameterExplainsTwoMissingLegsOfASide) {
  const Episode walk = tripod_on(without(Leg::rear_left, Leg::mid_left));
  EXPECT_GT(unexplained(walk, blamed(walk)), 0.06);
}

TEST(MujocoPlant, DamageIsOfTheLegsAndTheJointsThatAreNamed) {
  const Episode blocked = tripod_on(hurt(Leg::mid_left, Damage::blocked, Options::Joint::femur));
  const auto travel = [&](Index joint) { return blocked.true_states.col(kAngles + joint).cwiseAbs().maxCoeff(); };
  EXPECT_LT(travel(4), 0.05);
  EXPECT_GT(travel(3), 0.2);
  EXPECT_GT(travel(1), 0.2) << "the femur of another leg";
  const Episode two = tripod_on(without(Leg::mid_left, Leg::mid_right));
  EXPECT_TRUE(two.true_states.middleCols(kAngles + 3, 3).isZero(0));
  EXPECT_TRUE(two.true_states.middleCols(kAngles + 12, 3).isZero(0));
  EXPECT_FALSE(two.true_states.middleCols(kAngles, 3).isZero(0));
  EXPECT_EQ(std::get<scenario::SolidDrawing>(*make(without(Leg::mid_left, Leg::mid_right)).drawing).bodies.size(), 17u);
}

TEST(MujocoPlant, StartsDifferFromTrialToTrialWhereThatIsAskedFor) {
  EXPECT_EQ(tripod_on({}, 1).true_states, tripod_on({}, 2).true_states);
  Options options;
  options.start_noise = 0.02;
  const Episode first = tripod_on(options, 1), second = tripod_on(options, 2);
  EXPECT_EQ(first.states, tripod_on(options, 1).states);
  EXPECT_NE(first.true_states.bottomRows(1), second.true_states.bottomRows(1));
  const Vector start = first.true_states.row(0).transpose() - rest(), std = make(options).task.start_std;
  for (Index i = 0; i < kStateSize; ++i)
    EXPECT_LE(std::abs(start(i)), 5 * std(i)) << "6e-7 a number, seed 1; what does not vary is at rest";
  EXPECT_NEAR(std::sqrt(start.head(kJoints).squaredNorm() / kJoints), 0.02, 0.012) << "beyond that in 1e-3 of cases";
  EXPECT_NEAR(first.total_reward(), tripod_on({}).total_reward(), 0.3) << "it still walks";
}

TEST(MujocoPlant, PlantsKeepTheLawsWhateverIsDamaged) {
  std::vector<Options> all{{}, without(Leg::rear_left, Leg::mid_left)};
  for (Index leg = 1; leg <= kLegs; ++leg) all.push_back(without(static_cast<Leg>(leg)));
  for (const Damage kind : {Damage::blocked, Damage::weak})
    for (const Options::Joint joint : {Options::Joint::all, Options::Joint::tibia})
      all.push_back(hurt(Leg::front_right, kind, joint));
  for (Options& options : all) {
    options.start_noise = 0.05;
    const scenario::Scenario s = make(options);
    EXPECT_TRUE(s.task.violations().empty());
    for (const auto& broken : testing::check_plant(s.make_plant, s.task)) ADD_FAILURE() << broken;
  }
}

}  // namespace
}  // namespace rehearse::robots::hexapod
