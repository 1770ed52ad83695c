#pragma once

#include "rehearse/system/ode.hpp"

namespace rehearse::robots::cartpole {

/// The equations of the cart-pole: state x, ẋ, θ̇, θ; force on the cart; φ: m_pole, m_cart, l, b.
system::OdeKernel kernel();

}  // namespace rehearse::robots::cartpole
