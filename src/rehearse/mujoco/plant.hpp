#pragma once

#include <memory>

#include "rehearse/mujoco/description.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::mujoco {

/// A robot that MuJoCo plays. Positions and velocities of joints start around a mean; states that are read only follow
/// from them. What no state gives starts where the keyframe has it and moves on from step to step.
struct PlantOptions {
  SharedModel model;
  Vector phi;  // in the order of the model's parameters
  system::StartAndSensors around;
};

/// Use it as the robot of a scenario. `truth` is known. `step` throws std::runtime_error where the simulation diverges.
/// Throws InvalidInput, all violations at once.
std::unique_ptr<system::Plant> make_plant(const PlantOptions& options);

}  // namespace rehearse::mujoco
