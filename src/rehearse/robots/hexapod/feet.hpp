#pragma once
// The positions of the hexapod's segments and feet, from its state.

#include "rehearse/core/episode.hpp"
#include "rehearse/robots/hexapod/state.hpp"

namespace rehearse::robots::hexapod {

inline constexpr double kTouching = 0.005;  // m, of clearance; contacts are a little soft in both engines

Eigen::Isometry3d trunk_frame(const ConstVectorView& state);

/// The frames of a leg's segments in the world.
std::array<Eigen::Isometry3d, kJointsOfLeg> leg_frames(const ConstVectorView& state, Index leg);

/// The way from a foot's lowest point down to the floor, m; below 0 inside it.
double clearance(const ConstVectorView& state, Index leg);

/// The share of an episode's states after the first in which each foot touches the floor, one number a leg (Cully
/// 2015).
Vector duty_factors(const Episode& episode);

}  // namespace rehearse::robots::hexapod
