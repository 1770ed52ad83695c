#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::system {

/// The Gaussian start of an episode, and the Gaussian noise of its measurements.
struct StartAndSensors {
  Vector start_mean, start_std;    // dx
  Vector measurement_std;          // dx; empty: none
  std::vector<Index> angles = {};  // states that a program which keeps its own may give within one turn

  Vector start(Rng& rng) const;                          // the true state (dx)
  Vector measured(const Vector& state, Rng& rng) const;  // of a true state (dx)
  void check(Violations& violations) const;              // of sizes
};

/// The state after one control step from state x (dx) under the action u (du). It may throw.
using Motion = std::function<Vector(const Vector& x, const Vector& u)>;

/// Use it for a robot that a function simulates. Its `truth` is known. One thread. Throws InvalidInput where sizes
/// differ.
std::unique_ptr<Plant> make_simulated_plant(Motion motion, StartAndSensors around);

/// A plant that moves as a simulator with parameters phi predicts: it plays a robot that Rehearse does not drive.
/// States that the simulator cannot predict are NaN.
std::unique_ptr<Plant> make_simulated_plant(std::shared_ptr<const Simulator> simulator, Vector phi,
                                            StartAndSensors around);

}  // namespace rehearse::system
