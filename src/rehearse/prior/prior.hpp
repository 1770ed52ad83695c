#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/parameters.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::prior {

/// A simulator with a parameter space, used as the mean function of the dynamics' GPs. A value; any thread.
struct Prior {
  std::string name;
  std::shared_ptr<const system::Simulator> simulator;
  ParameterSpace space;  // the simulator's parameters, with the values to start from
  std::shared_ptr<const system::Simulator> driven = nullptr;  // for models that know where servos get to
                                                              // (scenario::NamedPrior); null: the simulator does
  std::shared_ptr<system::FirstFault> fault = nullptr;        // is told of rows that fail; null: nobody is

  /// The driven simulator in the place of the simulator.
  Prior behind_servos() const { return {name, driven ? driven : simulator, space, nullptr, fault}; }

  /// The simulator of the robot's own states, by what moves it.
  Prior behind_actuators() const {
    const auto robot_of = [](const auto& of) {
      const auto robot = of ? of->behind_actuators() : nullptr;
      return robot ? robot : of;
    };
    return {name, robot_of(simulator), space, robot_of(driven), fault};
  }

  /// Expected state changes (n × dx), contained: rows that fail are NaN. Returns how many failed.
  Index mean(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const {
    return system::change_contained(*simulator, X, U, phi, dX, fault.get());
  }
};

/// One prior whose discrete parameter `prior` (0, 1, …) chooses among several. Parameters of the same name are
/// shared when they are tunable in the same box in each prior that has them; others are kept apart as NAME@PRIOR. The
/// rest of a prior's parameters stay as it fixes them. Throws InvalidInput if fewer than two are given.
Prior choice(const std::vector<Prior>& priors);

}  // namespace rehearse::prior
