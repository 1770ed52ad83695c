#include "rehearse/robots/hexapod/drawing.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/robots/hexapod/feet.hpp"

namespace rehearse::robots::hexapod {
namespace {

scenario::Pose pose(const Eigen::Isometry3d& frame, const Eigen::Vector3d& middle) {
  return {frame * middle, Eigen::Quaterniond(frame.linear())};
}

bool has(const std::vector<Index>& legs, Index leg) { return std::find(legs.begin(), legs.end(), leg) != legs.end(); }

std::vector<scenario::Pose> poses(const std::vector<Index>& missing, const ConstVectorView& state) {
  std::vector<scenario::Pose> all = {pose(trunk_frame(state), Eigen::Vector3d::Zero())};
  for (Index leg = 0; leg < kLegs; ++leg) {
    if (has(missing, leg)) continue;
    const auto frames = leg_frames(state, leg);
    for (std::size_t i = 0; i < kSegments.size(); ++i) all.push_back(pose(frames[i], model_of(kSegments[i]).centre));
    all.push_back(pose(frames.back(), kFoot));
  }
  return all;
}

}  // namespace

scenario::SolidDrawing drawing(const std::vector<Index>& missing) {
  scenario::SolidDrawing drawing{
      .bodies = {{"trunk", scenario::Box{kTrunkSize}}}, .floor_m = 0, .touching_m = kTouching};
  for (Index leg = 0; leg < kLegs; ++leg) {
    if (has(missing, leg)) continue;
    const char* name = kLegNames[static_cast<std::size_t>(leg)];
    for (const Segment segment : kSegments)
      drawing.bodies.push_back({fmt::format("{} {}", name, name_of(segment)), scenario::Box{model_of(segment).size}});
    drawing.bodies.push_back({fmt::format("{} foot", name), scenario::Sphere{kFootRadius}, true});
  }
  drawing.poses = [missing](const ConstVectorView& state) { return poses(missing, state); };
  return drawing;
}

}  // namespace rehearse::robots::hexapod
