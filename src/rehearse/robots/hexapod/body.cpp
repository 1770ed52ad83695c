#include "rehearse/robots/hexapod/body.hpp"

#include <numbers>

namespace rehearse::robots::hexapod {
namespace {

constexpr double kCoxaLength = 0.06, kFemurLength = 0.085, kTibiaLength = 0.14;  // m
constexpr double kThickness = 0.03;                                              // of every segment, m
constexpr double kQuarter = std::numbers::pi / 4;

struct Hip {
  double x, y, yaw;
};
constexpr std::array<Hip, kLegs> kHips = {{{-0.13, 0.04, 0.3},
                                           {-0.01, 0.08, 0},
                                           {0.11, 0.04, -0.3},
                                           {0.11, -0.04, 0.3},
                                           {-0.01, -0.08, 0},
                                           {-0.13, -0.04, -0.3}}};

}  // namespace

const char* name_of(Segment segment) { return std::array{"coxa", "femur", "tibia"}[static_cast<std::size_t>(segment)]; }

Segment segment_of(Index joint) { return kSegments[static_cast<std::size_t>(joint % kJointsOfLeg)]; }

SegmentModel model_of(Segment segment) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), left = Eigen::Vector3d::UnitY();
  switch (segment) {
    case Segment::coxa:
      return {up, {kCoxaLength / 2, 0, 0}, {kCoxaLength, kThickness, kThickness}, 0.02, {-2 * kQuarter, 2 * kQuarter}};
    case Segment::femur:
      return {left, {kFemurLength / 2, 0, 0}, {kFemurLength, kThickness, kThickness}, 0.184, {-kQuarter, kQuarter}};
    case Segment::tibia:
      break;
  }
  return {left, {0, 0, -kTibiaLength / 2}, {kThickness, kThickness, kTibiaLength}, 0.04, {-kQuarter, kQuarter}};
}

Eigen::Isometry3d mount_of(Index leg, Segment segment) {
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  if (segment == Segment::coxa) {
    const Hip& hip = kHips[static_cast<std::size_t>(leg)];
    const double sideways = hip.y > 0 ? 2 * kQuarter : -2 * kQuarter;
    mount.translation() << hip.x, hip.y, 0;
    mount.linear() = Eigen::AngleAxisd(sideways + hip.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  } else {
    mount.translation().x() = segment == Segment::femur ? kCoxaLength : kFemurLength;
  }
  return mount;
}

Eigen::Vector3d box_inertia(const Eigen::Vector3d& size, double mass) {
  const Eigen::Vector3d squares = size.cwiseAbs2();
  return mass / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
}

}  // namespace rehearse::robots::hexapod
