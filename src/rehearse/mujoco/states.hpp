#pragma once
// States of a description as numbers of MuJoCo's data. For the files of this room.

#include <string>
#include <vector>

#include "rehearse/mujoco/description.hpp"
#include "rehearse/mujoco/engine.hpp"

namespace rehearse::mujoco {

/// The numbers that states are read from, and how positions and velocities of joints are set from them.
class States {
 public:
  States() = default;
  States(const mjModel& model, const std::vector<State>& states, Violations& violations);

  Index size() const { return static_cast<Index>(states_.size()); }

  /// Sets the joints that x (dx) gives. Nothing else changes.
  void write(const Vector& x, mjData& data) const;

  /// Computes the numbers that `read` needs from the data's positions and velocities. Call it within `guarded`.
  void prepare(const mjModel& model, mjData& data) const;

  /// Writes x (dx). Read-only states are those of the last `prepare`.
  void read(const mjData& data, Vector& x) const;

  /// True if a state gives this joint's position or velocity.
  bool gives(State::Kind kind, int joint) const;

 private:
  struct Number {
    int address;  // in the data's array of this kind
    double factor;
  };
  struct Reading {
    State::Kind kind;
    double offset;
    std::vector<Number> numbers;
  };
  /// joint = inverse · (state − offset), for all positions or all velocities.
  struct Setting {
    std::vector<Index> states;
    std::vector<int> joints, addresses;
    Matrix inverse;

    void add_joint(const mjModel& model, const Term& term);
    Matrix factors(const mjModel& model, const std::vector<State>& of) const;  // a row a state, a column a joint
    bool invert(const Matrix& factors);
    void write(const Vector& x, const std::vector<Reading>& states, double* numbers) const;
  };

  int address(const mjModel& model, const State& state, const Term& term, Violations& violations) const;
  static Setting setting(const mjModel& model, const std::vector<State>& states, State::Kind kind,
                         Violations& violations);

  std::vector<Reading> states_;
  Setting positions_, velocities_;
  bool places_ = false, sensors_ = false;  // whether a state reads some
};

}  // namespace rehearse::mujoco
