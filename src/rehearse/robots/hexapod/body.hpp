#pragma once
// The hexapod's body, from which the models of both engines are made. Frames: x forward, y left, z up; legs 0..5 are
// rear-left, mid-left, front-left, front-right, mid-right, rear-right.

#include <array>

#include <Eigen/Geometry>

#include "rehearse/core/types.hpp"

namespace rehearse::robots::hexapod {

inline constexpr Index kLegs = 6, kJointsOfLeg = 3, kJoints = kLegs * kJointsOfLeg;
inline constexpr std::array<const char*, kLegs> kLegNames = {"rear-left",   "mid-left",  "front-left",
                                                             "front-right", "mid-right", "rear-right"};
enum class Segment { coxa, femur, tibia };
inline constexpr std::array<Segment, kJointsOfLeg> kSegments = {Segment::coxa, Segment::femur, Segment::tibia};

const char* name_of(Segment segment);
Segment segment_of(Index joint);  // joints are numbered leg by leg

inline const Eigen::Vector3d kTrunkSize{0.24, 0.20, 0.04};  // m
inline constexpr double kTrunkMass = 1.031;                 // kg
inline constexpr double kRestHeight = 0.1525;               // m, of the trunk's middle, on all feet with zero angles
inline constexpr double kFootRadius = 0.025;                // m
inline const Eigen::Vector3d kFoot{0, 0, -0.1275};          // its middle, in the tibia's frame

/// A rigid body that hangs on a hinge at the origin of its own frame. With zero angles the frames of a leg are
/// parallel: x away from the trunk, z up.
struct SegmentModel {
  Eigen::Vector3d axis;    // of the hinge; a femur's or tibia's positive angle presses the foot down
  Eigen::Vector3d centre;  // of mass, m
  Eigen::Vector3d size;    // of a box that has its inertia, m
  double mass;             // kg
  Interval limits;         // of the angle, rad
};
SegmentModel model_of(Segment segment);

/// The pose of the segment's frame in that of the body that carries it, with a zero angle.
Eigen::Isometry3d mount_of(Index leg, Segment segment);

/// The moments of inertia of a solid box about its centre of mass.
Eigen::Vector3d box_inertia(const Eigen::Vector3d& size, double mass);

}  // namespace rehearse::robots::hexapod
