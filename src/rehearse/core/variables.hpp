#pragma once

#include <string>

#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse {

struct StateVariable {
  std::string name;
  std::string unit;
  StateKind kind = StateKind::plain;
  std::string rate = {};    // name of the state that is its derivative by time; empty: none is
  std::string parent = {};  // of an angle: name of the angle of the link that carries this one, both measured from one
                            // direction; empty: none does
};

/// The actuator between the action that a policy wants and the one that moves the robot (actuators.hpp).
struct Actuation {
  double max_rate = kInf;  // of the command: units of the action a second; infinite: any
  double filter_s = 0;     // time constant of the first-order low-pass that the command goes through; 0: none
  double delay_s = 0;      // from the command until the robot gets it
  double lag_s = 0;        // time constant with which the robot then follows it; 0: at once
  Index remember = 0;      // policies see the commands of so many steps before, or of more where the above need them

  bool operator==(const Actuation&) const = default;
};

struct ActionVariable {
  std::string name;  // of no state
  std::string unit;
  Interval bounds;
  std::string target_of = {};   // name of the state that it commands (a servo's angle): models see its distance from
                                // that state; empty: none
  std::string servo_type = {};  // of the servo whose target it is: those of one type are alike; empty: like no other
  Actuation actuation = {};
};

}  // namespace rehearse
