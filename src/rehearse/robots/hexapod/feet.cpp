#include "rehearse/robots/hexapod/feet.hpp"

namespace rehearse::robots::hexapod {

Eigen::Isometry3d trunk_frame(const ConstVectorView& state) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = orientation_of(state).toRotationMatrix();
  frame.translation() = state.segment(kPosition, 3);
  return frame;
}

std::array<Eigen::Isometry3d, kJointsOfLeg> leg_frames(const ConstVectorView& state, Index leg) {
  std::array<Eigen::Isometry3d, kJointsOfLeg> frames;
  Eigen::Isometry3d frame = trunk_frame(state);
  for (std::size_t i = 0; i < kSegments.size(); ++i) {
    const double angle = state(kAngles + leg * kJointsOfLeg + static_cast<Index>(i));
    frame = frame * mount_of(leg, kSegments[i]) * Eigen::AngleAxisd(angle, model_of(kSegments[i]).axis);
    frames[i] = frame;
  }
  return frames;
}

double clearance(const ConstVectorView& state, Index leg) {
  return (leg_frames(state, leg).back() * kFoot).z() - kFootRadius;
}

Vector duty_factors(const Episode& episode) {
  Vector shares = Vector::Zero(kLegs);
  for (Index t = 1; t <= episode.steps(); ++t)
    for (Index leg = 0; leg < kLegs; ++leg)
      shares(leg) += clearance(episode.true_states.row(t).transpose(), leg) < kTouching;
  return shares / static_cast<double>(std::max<Index>(episode.steps(), 1));
}

}  // namespace rehearse::robots::hexapod
