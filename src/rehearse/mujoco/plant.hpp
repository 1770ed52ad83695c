#pragma once

#include <memory>

#include "rehearse/mujoco/description.hpp"
#include "rehearse/system/plant.hpp"

namespace rehearse::mujoco {

/// A robot that MuJoCo plays. Positions and velocities of joints start at N(start_mean, diag(start_std²)); states that
/// are read only follow from them. What no state gives starts where the keyframe has it and moves on from step to step.
struct PlantOptions {
  ModelDescription model;
  Vector phi;                    // in the order of the model's parameters
  Vector start_mean, start_std;  // dx
  Vector measurement_std;        // dx; empty: none
};

/// Use it as the robot of a scenario. `truth` is known. `step` throws std::runtime_error where the simulation diverges.
/// Throws InvalidInput, all violations at once.
std::unique_ptr<system::Plant> make_plant(const PlantOptions& options);

}  // namespace rehearse::mujoco
