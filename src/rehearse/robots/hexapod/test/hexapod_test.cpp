#include "rehearse/robots/hexapod/hexapod.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/gait.hpp"
#include "rehearse/robots/hexapod/dart_simulator.hpp"
#include "rehearse/robots/hexapod/state.hpp"
#include "rehearse/robots/hexapod/test/damaged.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/testing/check_plant.hpp"
#include "rehearse/testing/check_policy.hpp"
#include "rehearse/testing/check_simulator.hpp"

namespace rehearse::robots::hexapod {
namespace {

/// The states and actions of a walk in DART: T+1 × 48, T × 18; fewer after a fall.
Dataset walk_in_dart(const Vector& theta, double missing, Index steps = 40) {
  const scenario::Scenario s = make({});
  const Matrix Theta = theta.transpose();
  Dataset walk{Matrix(steps, kStateSize), Matrix(steps, kJoints), Matrix(steps, kStateSize), {}};
  Matrix X = rest().transpose(), U(1, kJoints), dX(1, kStateSize);
  for (Index t = 0; t < steps; ++t) {
    s.policy->act(Theta, X, 0.1 * static_cast<double>(t), U);
    s.priors.front().simulator->change(X, U, Vector{{missing}}, dX);
    walk.states.row(t) = X;
    walk.actions.row(t) = U;
    walk.changes.row(t) = dX;
    X += dX;
    if (holds(s.task.ended, X.row(0).transpose().eval())) {
      for (Matrix* m : {&walk.states, &walk.actions, &walk.changes}) m->conservativeResize(t + 1, Eigen::NoChange);
      break;
    }
  }
  return walk;
}

Vector last_state(const Dataset& walk) { return (walk.states.bottomRows(1) + walk.changes.bottomRows(1)).transpose(); }

Vector walk_in_mujoco(const Options& options, const Vector& theta, Index& steps) {
  const scenario::Scenario s = make(options);
  const auto plant = s.make_plant();
  Rng rng({.purpose = Purpose::test});
  plant->reset(rng);
  const Matrix Theta = theta.transpose();
  Matrix U(1, kJoints);
  for (steps = 0; steps < 40 && !holds(s.task.ended, plant->truth()); ++steps) {
    s.policy->act(Theta, plant->truth().transpose(), 0.1 * static_cast<double>(steps), U);
    plant->step(U.row(0).transpose());
  }
  return plant->truth();
}

TEST(Hexapod, TripodWalksInBothEngines) {
  const Dataset walk = walk_in_dart(policy::tripod_gait(), -1);
  ASSERT_EQ(walk.size(), 40);
  const double in_dart = last_state(walk)(kPosition) / 4;
  Index steps = 0;
  const double in_mujoco = walk_in_mujoco({}, policy::tripod_gait(), steps)(kPosition) / 4;
  RecordProperty("dart_m_per_s", std::to_string(in_dart));
  RecordProperty("mujoco_m_per_s", std::to_string(in_mujoco));
  EXPECT_EQ(steps, 40);
  EXPECT_GT(in_dart, 0.12);
  EXPECT_LT(in_dart, 0.25);
  EXPECT_GT(in_mujoco, 0.12);
  EXPECT_LT(in_mujoco, 0.3);
}

TEST(Hexapod, TripodFallsWithoutARearLegInBothEngines) {
  EXPECT_LT(walk_in_dart(policy::tripod_gait(), 0).size(), 20);
  Index steps = 0;
  walk_in_mujoco({.damage = Options::Leg::rear_left}, policy::tripod_gait(), steps);
  EXPECT_LT(steps, 20);
}

TEST(Hexapod, StandsStillInBothEngines) {
  const Vector still = Vector::Zero(36);  // all amplitudes are zero
  const Vector in_dart = last_state(walk_in_dart(still, -1));
  Index steps = 0;
  const Vector in_mujoco = walk_in_mujoco({}, still, steps);
  for (const Vector& state : {in_dart, in_mujoco}) {
    EXPECT_LT(state.segment(kPosition, 2).norm(), 0.01);
    EXPECT_NEAR(state(kPosition + 2), kRestHeight, 0.01);
    EXPECT_GT(uprightness(state), 0.999);
    EXPECT_LT(state.segment(kSpeeds, kJoints).cwiseAbs().maxCoeff(), 0.1);
  }
}

TEST(Hexapod, IsDrawnOnItsFeet) {
  for (const Options::Leg leg : {Options::Leg::none, Options::Leg::mid_right}) {
    const auto drawing = std::get<scenario::SolidDrawing>(*make({.damage = leg}).drawing);
    const auto poses = drawing.poses(rest());
    ASSERT_EQ(poses.size(), drawing.bodies.size());
    EXPECT_EQ(poses.size(), leg == Options::Leg::none ? 25u : 21u);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto* foot = std::get_if<scenario::Sphere>(&drawing.bodies[i].shape);
      if (foot) {
        EXPECT_NEAR(poses[i].position.z(), foot->radius_m, 1e-12) << drawing.bodies[i].name;
      }
    }
  }
}

/// A walk as an episode.
Episode episode_of(const Dataset& walk) {
  Episode episode{.states = Matrix(walk.size() + 1, kStateSize), .actions = walk.actions};
  episode.states << walk.states, last_state(walk).transpose();
  episode.true_states = episode.states;
  return episode;
}

TEST(Hexapod, DutyFactorsSayHowLongFeetAreOnTheFloor) {
  const Task task = make({}).task;
  const Vector standing = task.descriptor(episode_of(walk_in_dart(Vector::Zero(36), -1)));
  EXPECT_EQ(standing, Vector::Ones(kLegs));
  const Vector walking = task.descriptor(episode_of(walk_in_dart(policy::tripod_gait(), -1)));
  EXPECT_GT(walking.minCoeff(), 0.2);
  EXPECT_LT(walking.maxCoeff(), 0.8);
  Vector five = Vector::Zero(36);
  five.segment(6, 6) << 0, 0, 0, 1, 0, 0;  // the second leg's femur is held up
  Vector expected = Vector::Ones(kLegs);
  expected(1) = 0;
  EXPECT_LT((task.descriptor(episode_of(walk_in_dart(five, -1))) - expected).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Hexapod, AStepThatFliesOffEarnsLittle) {
  const Task task = make({}).task;
  Matrix X = rest().transpose().replicate(3, 1), next = X;
  next(0, kPosition) = 0.03;
  next(1, kPosition) = 7;
  next(2, kPosition) = -7;
  Vector rewards(3);
  task.reward(X, Matrix::Zero(3, kJoints), next, rewards);
  EXPECT_EQ(rewards, (Vector{{0.03, 0.1, -0.1}}));
}

TEST(Hexapod, HasTheMassOfTheRealOne) {
  double mass = kTrunkMass;
  for (const Segment segment : kSegments) mass += kLegs * model_of(segment).mass;
  EXPECT_NEAR(mass, 2.495, 1e-9);
}

TEST(Hexapod, AMissingLegIsZeroInBothEngines) {
  const Dataset walk = walk_in_dart(policy::tripod_gait(), 1, 3);
  Index steps = 0;
  const Vector real = walk_in_mujoco({.damage = Options::Leg::mid_left}, policy::tripod_gait(), steps);
  for (const Vector& state : {last_state(walk), real})
    for (const Index first : {kAngles, kSpeeds}) {
      EXPECT_TRUE(state.segment(first + 3, 3).isZero(0));
      EXPECT_FALSE(state.segment(first, 3).isZero(0));
    }
}

TEST(Hexapod, DamageThatContradictsItselfIsRefused) {
  const auto refusal = [](const Options& options) -> std::string {
    try {
      make(options);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal(without(Leg::none, Leg::mid_left)),
            "second_damage names a leg, but damage = none: name the first there");
  EXPECT_EQ(refusal(without(Leg::mid_left, Leg::mid_left)),
            "second_damage names the leg of damage, must be another one");
  EXPECT_EQ(refusal(hurt(Leg::none, Damage::weak)), "damage_kind and damage_joint need a leg, but damage = none");
  EXPECT_EQ(refusal(hurt(Leg::rear_left, Damage::removed, Options::Joint::femur)),
            "damage_joint must be all where damage_kind = removed");
}

TEST(Hexapod, OptionsOutOfBoundsAreNamed) {
  Options options;
  options.start_noise = -1;
  options.servo_lag_s = 11;
  options.plant.friction = 0;
  EXPECT_EQ(field_violations([&](FieldVisitor& v) { options.fields(v); }),
            (std::vector<std::string>{"plant.friction = 0, must be > 0", "start_noise = -1, must be between 0 and 0.5",
                                      "servo_lag_s = 11, must be between 0 and 10"}));
}

/// The robot's walk, a step of 0.1 s at a time: where it is while its feet push.
TEST(Hexapod, FollowsFromJointsThatAreDrivenAsInTheOtherEngine) {
  const scenario::Scenario s = make({});
  const auto plant = s.make_plant();
  const Episode walk =
      rollout::execute(*plant, *s.policy, policy::tripod_gait(), s.task, Rng({.purpose = Purpose::test}));
  const auto way = [&](const system::Simulator& simulator) {
    Matrix X = walk.true_states.topRows(1), dX(1, kStateSize);
    for (Index t = 0; t < walk.steps(); ++t, X += dX)
      simulator.change(X, walk.true_states.block(t + 1, kAngles, 1, kJoints), Vector{{-1}}, dX);
    EXPECT_LT((X - walk.true_states.bottomRows(1)).leftCols(kJoints).cwiseAbs().maxCoeff(), 0.02);
    return X(0, kPosition);
  };
  const double real = walk.true_states(walk.steps(), kPosition);
  EXPECT_NEAR(way(*s.priors.front().driven) / real, 1, 0.1);
  EXPECT_LT(way(*s.priors.front().simulator) / real, 0.85);
}

TEST(Hexapod, DamageChangesTheWalk) {
  Index steps = 0;
  const Vector intact = walk_in_mujoco({}, policy::tripod_gait(), steps);
  for (const Damage kind : {Damage::blocked, Damage::weak}) {
    const Vector hurt = walk_in_mujoco({.damage = Options::Leg::mid_left, .kind = kind}, policy::tripod_gait(), steps);
    EXPECT_GT((hurt - intact).norm(), 0.01);
  }
  const Vector blocked =
      walk_in_mujoco({.damage = Options::Leg::mid_left, .kind = Damage::blocked}, policy::tripod_gait(), steps);
  EXPECT_LT(blocked.segment(kAngles + 3, 3).cwiseAbs().maxCoeff(), 0.2);
}

TEST(Hexapod, RotationVectorsComeBack) {
  Rng rng({.purpose = Purpose::test});
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized();
    Vector state = rest();
    state.segment(kRotation, 3) = rotation_vector(q);
    EXPECT_LT(state.segment(kRotation, 3).norm(), 3.15);
    EXPECT_LT(orientation_of(state).angularDistance(q), 1e-7);
  }
}

TEST(Hexapod, KeepsTheLaws) {
  const scenario::Scenario s = make({});
  EXPECT_TRUE(s.task.violations().empty());
  for (const auto& broken : testing::check_policy(*s.policy, s.task)) ADD_FAILURE() << broken;
  const Dataset walk = walk_in_dart(policy::tripod_gait(), -1, 12);
  for (const auto& simulator : {s.priors.front().simulator, s.priors.front().driven})
    for (const double missing : {-1.0, 5.0})
      for (const auto& broken : testing::check_simulator(*simulator, walk.states, walk.actions, Vector{{missing}}))
        ADD_FAILURE() << broken;
}

TEST(Hexapod, HostileStatesAreAnsweredWithNaNOrNumbers) {
  const scenario::Scenario s = make({});
  Rng rng({.purpose = Purpose::test});
  constexpr Index rows = 5000;
  Matrix X(rows, kStateSize), U(rows, kJoints), dX(rows, kStateSize);
  for (Index i = 0; i < rows; ++i) {
    const double scale = std::pow(10, rng.uniform(-1, 3));
    for (Index j = 0; j < kStateSize; ++j) X(i, j) = rest()(j) + scale * rng.normal();
    for (Index j = 0; j < kJoints; ++j) U(i, j) = scale * rng.normal();
  }
  const auto& servos = s.priors.front().simulator;
  const auto& driven = s.priors.front().driven;
  for (const auto& [simulator, missing] : {std::pair(servos, -1.0), std::pair(servos, 0.0), std::pair(driven, 0.0)}) {
    simulator->change(X, U, Vector{{missing}}, dX);
    Index numbers = 0;
    for (Index i = 0; i < rows; ++i) {
      EXPECT_TRUE(dX.row(i).allFinite() || dX.row(i).array().isNaN().all());
      numbers += dX.row(i).allFinite();
    }
    EXPECT_GT(numbers, 0);
    EXPECT_LT(numbers, rows);
  }
}

}  // namespace
}  // namespace rehearse::robots::hexapod
