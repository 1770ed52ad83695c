#pragma once

#include <memory>
#include <optional>
#include <string>

#include "rehearse/core/options.hpp"
#include "rehearse/robots/hexapod/body.hpp"
#include "rehearse/system/plant.hpp"

namespace rehearse::robots::hexapod {

/// What a robot's servos and sensors are like.
struct Hardware {
  double stall_torque = 1.2;   // N m
  double free_speed = 5.8;     // rad/s, at which a servo has no torque left
  double stiffness = 12;       // N m/rad, of the servos' own control
  double damping = 0.25;       // N m s/rad
  double latency_s = 0.02;     // until a target reaches the servos
  double friction = 0.7;       // of feet on the floor
  double angle_noise = 0.002;  // rad and m, std of what is measured of angles, rotation and position
  double speed_noise = 0.02;   // rad/s and m/s, of speeds
  void fields(FieldVisitor& v);
};

enum class Damage {
  removed,  // the leg is gone
  blocked,  // its joints do not move
  weak,     // its servos have a quarter of their torque
};

struct DamagedLeg {
  Index leg = 0;
  Damage damage = Damage::removed;
};

/// The hexapod in MuJoCo, in the place of a real one: torque-limited servos with latency, joint friction, soft elliptic
/// contacts, noisy sensors. An episode starts with the robot standing. step throws if the simulation diverges.
std::unique_ptr<system::Plant> make_mujoco_plant(const Hardware& hardware, std::optional<DamagedLeg> damaged,
                                                 double dt_s);

/// Its model in MuJoCo's own format.
std::string mujoco_model(const Hardware& hardware, std::optional<Index> missing);

}  // namespace rehearse::robots::hexapod
