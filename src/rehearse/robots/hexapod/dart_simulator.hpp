#pragma once

#include <memory>

#include "rehearse/system/simulator.hpp"

namespace rehearse::robots::hexapod {

/// The motion of joints to their targets.
enum class Joints {
  servos,  // as fast as possible, then at rest
  driven,  // evenly, to be there when the step ends
};

/// The hexapod in DART: joints that follow any speed, friction 1; those of servos get to their targets with a time
/// constant of π/100 s and `lag_s` more. One parameter: `missing_leg`, one of the legs or −1 for none. A row outside
/// what DART survives (its assertions end the process), before or after any step, is NaN. As many worlds are kept as
/// threads have asked at the same time.
std::shared_ptr<const system::Simulator> make_dart_simulator(double dt_s, Joints moved = Joints::servos,
                                                             double lag_s = 0);

}  // namespace rehearse::robots::hexapod
