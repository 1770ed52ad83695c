#include "rehearse/robots/hexapod/hexapod.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/gait.hpp"
#include "rehearse/robots/hexapod/dart_simulator.hpp"
#include "rehearse/robots/hexapod/drawing.hpp"
#include "rehearse/robots/hexapod/feet.hpp"
#include "rehearse/scenario/builder.hpp"
#include "rehearse/system/isolation.hpp"

namespace rehearse::robots::hexapod {
namespace {

constexpr double kControlStep = 0.1;  // s
constexpr double kFallen = 0.5;       // cosine of the tilt: 60°
constexpr double kSolvedSpeed = 0.2;  // m/s
constexpr double kLongestStep = 0.1;  // m that a step of 0.1 s earns at most, up or down: no gait is so fast, but
                                      // simulated episodes that a model lets fly off are

/// The way forward in a step, or x·dt; where the robot has drifted, at most 0.
Reward reward(double drift_m, bool integral) {
  return [drift_m, integral](const ConstMatrixView& X, const ConstMatrixView&, const ConstMatrixView& next,
                             VectorView rewards) {
    if (integral)
      rewards = kControlStep * next.col(kPosition);
    else
      rewards = (next.col(kPosition) - X.col(kPosition)).cwiseMax(-kLongestStep).cwiseMin(kLongestStep);
    for (Index i = 0; i < next.rows(); ++i)
      if (std::abs(next(i, kPosition + 1)) > drift_m) rewards(i) = std::min(rewards(i), 0.0);
  };
}

std::vector<std::string> descriptor_names() {
  std::vector<std::string> names;
  for (const char* leg : kLegNames) names.push_back(fmt::format("time on the floor, {}", leg));
  return names;
}

Task make_task(const Options& options) {
  Task task;
  task.states = state_variables();
  task.actions = action_variables();
  task.start_mean = rest();
  task.start_std = Vector::Zero(kStateSize);
  task.start_std.segment(kAngles, kJoints).setConstant(options.start_noise);
  task.start_std(kRotation + 2) = options.start_noise;
  task.dt_s = kControlStep;
  task.horizon = options.horizon;
  task.reward = reward(options.drift_m, options.integral);
  task.reward_floor = options.fall_reward;
  task.ended = each_state([](const ConstVectorView& state) { return uprightness(state) < kFallen; });
  task.solved = [seconds = task.episode_s(), steps = task.horizon](const Episode& e) {
    return !e.ended && e.steps() == steps &&
           e.true_states(steps, kPosition) - e.true_states(0, kPosition) >= kSolvedSpeed * seconds;
  };
  task.descriptor = duty_factors;
  task.descriptor_bounds = std::vector<Interval>(kLegs, {0, 1});
  task.descriptor_names = descriptor_names();
  return task;
}

/// Throws InvalidInput if options of the damage contradict each other.
void check_damage(const Options& options) {
  const bool first = options.damage != Options::Leg::none, second = options.second_damage != Options::Leg::none;
  const bool removed = options.kind == Damage::removed, whole = options.joint == Options::Joint::all;
  Violations violations;
  violations.require(first || !second, "second_damage names a leg, but damage = none: name the first there");
  violations.require(!first || options.damage != options.second_damage,
                     "second_damage names the leg of damage, must be another one");
  violations.require(first || (removed && whole), "damage_kind and damage_joint need a leg, but damage = none");
  violations.require(!removed || whole, "damage_joint must be all where damage_kind = removed");
  violations.throw_if_any();
}

DamagedLegs damaged_legs(const Options& options) {
  DamagedLegs damaged{.legs = {}, .damage = options.kind, .segment = std::nullopt};
  for (const Options::Leg leg : {options.damage, options.second_damage})
    if (leg != Options::Leg::none) damaged.legs.push_back(static_cast<Index>(leg) - 1);
  if (options.joint != Options::Joint::all) damaged.segment = kSegments[static_cast<std::size_t>(options.joint) - 1];
  return damaged;
}

std::shared_ptr<const system::Simulator> make_simulator(const Options& options, Joints moved) {
  auto simulator = make_dart_simulator(kControlStep, moved, options.servo_lag_s);
  return options.isolated ? system::isolated(simulator) : simulator;
}

}  // namespace

void Options::fields(FieldVisitor& v) {
  v.group("plant", plant);
  std::vector<std::string> legs{"none"};
  legs.insert(legs.end(), kLegNames.begin(), kLegNames.end());
  v.choice("damage", damage, "leg that is damaged", legs);
  v.choice("second_damage", second_damage, "another leg that is damaged", legs);
  v.choice("damage_kind", kind, "the leg is gone, its joints are stiff, or its servos have a quarter of their torque",
           {"removed", "blocked", "weak"});
  v.choice("damage_joint", joint, "which of the leg's joints is blocked or weak", {"all", "coxa", "femur", "tibia"});
  v.number("start_noise", start_noise, "standard deviation of joints and heading at the start of a trial [rad]",
           between(0, 0.5));
  v.number("servo_lag_s", servo_lag_s, "addition to the prior's servo time constant, which is π/100 s [s]",
           between(0, 10));
  v.integer("horizon", horizon, "steps of an episode, 0.1 s each", between(1, 1e6));
  v.number("drift_m", drift_m, "lateral drift beyond which the reward is at most 0 [m]", above(0));
  v.number("fall_reward", fall_reward, "reward for each remaining step after a fall [m]", between(-1e6, 0));
  v.boolean("integral", integral, "reward of a step: distance so far × 0.1 s, not the distance of that step");
  v.boolean("isolated", isolated, expert("DART runs in separate processes, which it may crash"));
}

scenario::Scenario make(const Options& options) {
  check_damage(options);
  const auto simulator = make_simulator(options, Joints::servos);
  const DamagedLegs damaged = damaged_legs(options);
  return {
      .name = "hexapod",
      .task = make_task(options),
      .make_plant = [options,
                     damaged] { return make_mujoco_plant(options.plant, damaged, options.start_noise, kControlStep); },
      .priors = {{"intact", simulator, simulator->parameters(), make_simulator(options, Joints::driven)}},
      .policy = policy::make_gait(kLegs),
      .drawing = drawing(damaged.removed())};
}

std::unique_ptr<scenario::ScenarioBuilder> builder() {
  return scenario::make_builder("walk on six legs, or on five (40 steps of 0.1 s); solved: 0.2 m/s and no fall", make);
}

}  // namespace rehearse::robots::hexapod
