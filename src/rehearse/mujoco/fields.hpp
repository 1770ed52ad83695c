#pragma once
// The numbers of a model that parameters may move. For the files of this room.

#include <string>

#include "rehearse/mujoco/description.hpp"
#include "rehearse/mujoco/engine.hpp"

namespace rehearse::mujoco {

/// One field of one kind of element.
struct Field {
  const char* kind;
  const char* name;
  mjtObj type;  // mjOBJ_UNKNOWN: of the whole model
  int size;     // numbers of an element; 0: one for each degree of freedom of a joint
  mjtNum* (*first)(mjModel& model, int id);
  bool constants = false;                                         // mj_setConst must follow
  void (*follow)(mjModel& model, int id) = [](mjModel&, int) {};  // what else depends on it
};

/// Numbers of one element of a model, and of its copies.
struct Entries {
  const Field* field = nullptr;
  int id = 0;
  int begin = 0, end = 0;  // of the numbers of its field

  double* at(mjModel& model) const { return field->first(model, id) + begin; }
  int size() const { return end - begin; }
};

/// The numbers that a target names; none, and a violation, if there are none. `where` begins the message.
Entries find_entries(mjModel& model, const Target& target, const std::string& where, Violations& violations);

}  // namespace rehearse::mujoco
