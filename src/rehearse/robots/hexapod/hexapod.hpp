#pragma once
// The six-legged robot of Chatzilygeroudis 2018: walk forward as fast as possible, perhaps without one leg. The prior
// is the robot in DART, with servos that never lack torque; in the place of the real one stands a MuJoCo simulation
// with weaker, later and noisier ones.

#include <memory>

#include "rehearse/core/options.hpp"
#include "rehearse/robots/hexapod/mujoco_plant.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robots::hexapod {

struct Options {
  enum class Leg { none, rear_left, mid_left, front_left, front_right, mid_right, rear_right };
  enum class Joint { all, coxa, femur, tibia };
  Hardware plant;
  Leg damage = Leg::none;         // the leg that is damaged
  Leg second_damage = Leg::none;  // another damaged leg, with the same damage
  Damage kind = Damage::removed;
  Joint joint = Joint::all;  // which of its joints is blocked or weak
  double start_noise = 0;    // rad, std of joints and heading at the start of each trial
  double servo_lag_s = 0;    // added to the time constant of the prior's servos, π/100 s; 0.12 is nearest to the plant
  Index horizon = 40;        // steps of 0.1 s
  double drift_m = 0.5;      // to the side, beyond which nothing is earned (the authors' code: 0.5)
  double fall_reward = -0.02;  // m, for each step that a fall leaves out
  bool integral = false;       // earn x·dt a step instead of the way made (the authors' code)
  bool isolated = true;        // DART runs in processes of its own, which it may end
  void fields(FieldVisitor& v);
};

scenario::Scenario make(const Options& options);

std::unique_ptr<scenario::ScenarioBuilder> builder();

}  // namespace rehearse::robots::hexapod
