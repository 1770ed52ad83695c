#include "rehearse/robots/hexapod/drawing.hpp"

#include <fmt/format.h>

#include "rehearse/robots/hexapod/state.hpp"

namespace rehearse::robots::hexapod {
namespace {

scenario::Pose pose(const Eigen::Isometry3d& frame, const Eigen::Vector3d& middle) {
  return {frame * middle, Eigen::Quaterniond(frame.linear())};
}

Eigen::Isometry3d trunk_frame(const ConstVectorView& state) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = orientation_of(state).toRotationMatrix();
  frame.translation() = state.segment(kPosition, 3);
  return frame;
}

std::vector<scenario::Pose> poses(std::optional<Index> missing, const ConstVectorView& state) {
  const Eigen::Isometry3d trunk = trunk_frame(state);
  std::vector<scenario::Pose> all = {pose(trunk, Eigen::Vector3d::Zero())};
  for (Index leg = 0; leg < kLegs; ++leg) {
    if (leg == missing) continue;
    Eigen::Isometry3d frame = trunk;
    for (std::size_t i = 0; i < kSegments.size(); ++i) {
      const SegmentModel model = model_of(kSegments[i]);
      const double angle = state(kAngles + leg * kJointsOfLeg + static_cast<Index>(i));
      frame = frame * mount_of(leg, kSegments[i]) * Eigen::AngleAxisd(angle, model.axis);
      all.push_back(pose(frame, model.centre));
    }
    all.push_back(pose(frame, kFoot));
  }
  return all;
}

}  // namespace

scenario::SolidDrawing drawing(std::optional<Index> missing) {
  scenario::SolidDrawing drawing{.bodies = {{"trunk", scenario::Box{kTrunkSize}}}, .floor_m = 0};
  for (Index leg = 0; leg < kLegs; ++leg) {
    if (leg == missing) continue;
    const char* name = kLegNames[static_cast<std::size_t>(leg)];
    for (const Segment segment : kSegments)
      drawing.bodies.push_back({fmt::format("{} {}", name, name_of(segment)), scenario::Box{model_of(segment).size}});
    drawing.bodies.push_back({fmt::format("{} foot", name), scenario::Sphere{kFootRadius}});
  }
  drawing.poses = [missing](const ConstVectorView& state) { return poses(missing, state); };
  return drawing;
}

}  // namespace rehearse::robots::hexapod
