#pragma once
// The 48 numbers of the hexapod's state, as both engines write them.

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "rehearse/core/task.hpp"
#include "rehearse/robots/hexapod/body.hpp"

namespace rehearse::robots::hexapod {

inline constexpr Index kAngles = 0, kSpeeds = kJoints, kRotation = 2 * kJoints, kPosition = kRotation + 3,
                       kTurning = kPosition + 3, kMoving = kTurning + 3, kStateSize = kMoving + 3;

/// Angles and speeds of joints leg by leg (those of a leg that is missing are 0, and measured with noise), the trunk's
/// rotation vector and position in the world, its angular and linear velocity in its own frame.
std::vector<StateVariable> state_variables();

/// Targets of the joints' angles, leg by leg.
std::vector<ActionVariable> action_variables();

Eigen::Quaterniond orientation_of(const ConstVectorView& state);

/// The orientation as a rotation vector, of norm below π.
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& orientation);

/// The cosine of how far the trunk is tilted.
double uprightness(const ConstVectorView& state);

/// Standing on all feet, at rest.
Vector rest();

}  // namespace rehearse::robots::hexapod
