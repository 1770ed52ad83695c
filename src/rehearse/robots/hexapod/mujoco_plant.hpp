#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/robots/hexapod/body.hpp"
#include "rehearse/system/plant.hpp"

namespace rehearse::robots::hexapod {

/// The properties of a robot's servos and sensors.
struct Hardware {
  double stall_torque = 1.2;   // N m
  double free_speed = 5.8;     // rad/s, at which a servo has no torque left
  double stiffness = 12;       // N m/rad, of the servos' own control
  double damping = 0.25;       // N m s/rad
  double latency_s = 0.02;     // until a target reaches the servos
  double friction = 0.7;       // of feet on the floor
  double angle_noise = 0.002;  // rad and m, std of measured angles, rotation and position
  double speed_noise = 0.02;   // rad/s and m/s, of speeds
  void fields(FieldVisitor& v);
};

enum class Damage {
  removed,  // the leg is gone
  blocked,  // its joints do not move
  weak,     // its servos have a quarter of their torque
};

struct DamagedLegs {
  std::vector<Index> legs;  // none: the robot is intact
  Damage damage = Damage::removed;
  std::optional<Segment> segment;  // whose joint alone suffers; of a leg that is removed all do

  bool suffer(Index joint, Damage what) const;
  std::vector<Index> removed() const;
};

/// The hexapod in MuJoCo, in the place of a real one: torque-limited servos with latency, joint friction, soft elliptic
/// contacts, noisy sensors. An episode starts with the robot standing, its joints and its heading N(0, start_noise²),
/// rad. Joints of a leg that is removed read 0 with the noise of the others. step throws if the simulation diverges.
std::unique_ptr<system::Plant> make_mujoco_plant(const Hardware& hardware, const DamagedLegs& damaged,
                                                 double start_noise, double dt_s);

/// Its model in MuJoCo's own format.
std::string mujoco_model(const Hardware& hardware, const std::vector<Index>& removed);

}  // namespace rehearse::robots::hexapod
