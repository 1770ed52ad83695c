#pragma once

#include <array>
#include <memory>

#include "rehearse/core/types.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// A periodic signal of 1 s: amplitude for the first `duty` of it and −amplitude for the rest, smoothed by a Gaussian
/// of 0.03 s, and `phase` of a period ahead. All three lie in [0, 1]; the signal within ± amplitude. In hundredths of a
/// second, as in the hexapod controller of Cully 2015.
double gait_signal(double amplitude, double phase, double duty, double t_s);

/// Open loop, legs of three joints, each with a signal s₀ for its coxa and s₁ for its femur: targets π/8 · s₀,
/// π/4 · s₁, and −π/4 · s₁ for the tibia, which stays vertical (Cully 2015). θ in [0, 1]: of each leg amplitude, phase
/// and duty of s₀, then of s₁. Actions leg by leg. Throws InvalidInput if legs is not positive.
std::shared_ptr<const Policy> make_gait(Index legs);

/// θ by which a hexapod walks with three feet on the ground at a time (Cully 2015).
Vector tripod_gait();

}  // namespace rehearse::policy
