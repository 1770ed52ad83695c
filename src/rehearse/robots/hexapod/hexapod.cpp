#include "rehearse/robots/hexapod/hexapod.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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
                                      // imagined episodes that a model lets fly off are

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
  task.dt_s = kControlStep;
  task.horizon = options.horizon;
  task.reward = reward(options.drift_m, options.integral);
  task.reward_floor = options.fall_reward;
  task.ended = [](const ConstVectorView& state) { return uprightness(state) < kFallen; };
  task.solved = [seconds = task.episode_s(), steps = task.horizon](const Episode& e) {
    return !e.ended && e.steps() == steps &&
           e.true_states(steps, kPosition) - e.true_states(0, kPosition) >= kSolvedSpeed * seconds;
  };
  task.descriptor = duty_factors;
  task.descriptor_bounds = std::vector<Interval>(kLegs, {0, 1});
  task.descriptor_names = descriptor_names();
  return task;
}

std::optional<DamagedLeg> damaged_leg(const Options& options) {
  if (options.damage == Options::Leg::none) return std::nullopt;
  return DamagedLeg{static_cast<Index>(options.damage) - 1, options.kind};
}

std::optional<Index> removed_leg(const Options& options) {
  const auto damaged = damaged_leg(options);
  return damaged && damaged->damage == Damage::removed ? std::optional(damaged->leg) : std::nullopt;
}

std::shared_ptr<const system::Simulator> make_simulator(const Options& options, Joints moved) {
  auto simulator = make_dart_simulator(kControlStep, moved);
  return options.isolated ? system::isolated(simulator) : simulator;
}

}  // namespace

void Options::fields(FieldVisitor& v) {
  v.group("plant", plant);
  v.choice("damage", damage, {"none", "rear-left", "mid-left", "front-left", "front-right", "mid-right", "rear-right"});
  v.choice("damage_kind", kind, {"removed", "blocked", "weak"});
  v.integer("horizon", horizon, between(1, 1e6));
  v.number("drift_m", drift_m, above(0));
  v.number("fall_reward", fall_reward, between(-1e6, 0));
  v.boolean("integral", integral);
  v.boolean("isolated", isolated);
}

scenario::Scenario make(const Options& options) {
  const auto simulator = make_simulator(options, Joints::servos);
  return {.name = "hexapod",
          .task = make_task(options),
          .make_plant = [options] { return make_mujoco_plant(options.plant, damaged_leg(options), kControlStep); },
          .priors = {{"intact", simulator, simulator->parameters(), make_simulator(options, Joints::driven)}},
          .policy = policy::make_gait(kLegs),
          .drawing = drawing(removed_leg(options))};
}

std::unique_ptr<scenario::ScenarioBuilder> builder() {
  return scenario::make_builder("walk on six legs, or on five (40 steps of 0.1 s)", make);
}

}  // namespace rehearse::robots::hexapod
