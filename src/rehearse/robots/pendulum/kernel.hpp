#pragma once

#include "rehearse/system/ode.hpp"

namespace rehearse::robots::pendulum {

/// The equation of the pendulum: state θ̇, θ; torque on its axis; φ: m, l, b.
system::OdeKernel kernel();

}  // namespace rehearse::robots::pendulum
