#pragma once
// Parameters of a description as numbers of a model. For the files of this room.

#include <vector>

#include "rehearse/mujoco/fields.hpp"

namespace rehearse::mujoco {

/// The parameters of a description, as changes to a model and its copies.
class Parameters {
 public:
  Parameters() = default;
  Parameters(mjModel& original, const std::vector<ModelParameter>& parameters, Violations& violations);

  /// Moves the numbers of a copy of `original` to what they are at phi (in the description's order). True if
  /// mj_setConst must follow.
  bool apply(mjModel& original, const Vector& phi, mjModel& model) const;

  Index size() const { return size_; }

 private:
  struct Move {
    Entries entries;
    Index parameter;
    double factor, power;
    bool scale;

    double by(const Vector& phi) const;
  };
  void check_conflicts(const std::vector<ModelParameter>& parameters, Violations& violations) const;

  Index size_ = 0;
  std::vector<Move> moves_;  // those that set before those that scale
};

}  // namespace rehearse::mujoco
