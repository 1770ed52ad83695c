#include "rehearse/robots/hexapod/state.hpp"

#include <fmt/format.h>

namespace rehearse::robots::hexapod {
namespace {

std::string joint_name(Index joint) {
  return fmt::format("{} {}", kLegNames[static_cast<std::size_t>(joint / kJointsOfLeg)], name_of(segment_of(joint)));
}

}  // namespace

std::vector<StateVariable> state_variables() {
  std::vector<StateVariable> states;
  for (Index joint = 0; joint < kJoints; ++joint)
    states.push_back({joint_name(joint), "rad", StateKind::plain, "d " + joint_name(joint)});
  for (Index joint = 0; joint < kJoints; ++joint) states.push_back({"d " + joint_name(joint), "rad/s"});
  for (const char* axis : {"x", "y", "z"}) states.push_back({fmt::format("rotation {}", axis), "rad"});
  states.push_back({"x", "m", StateKind::omitted});
  states.push_back({"y", "m", StateKind::omitted});
  states.push_back({"z", "m"});
  for (const char* axis : {"x", "y", "z"}) states.push_back({fmt::format("omega {}", axis), "rad/s"});
  for (const char* axis : {"x", "y", "z"}) states.push_back({fmt::format("v {}", axis), "m/s"});
  return states;
}

std::vector<ActionVariable> action_variables() {
  std::vector<ActionVariable> actions;
  for (Index joint = 0; joint < kJoints; ++joint)
    actions.push_back({joint_name(joint) + " target", "rad", model_of(segment_of(joint)).limits, joint_name(joint),
                       name_of(segment_of(joint))});
  return actions;
}

Eigen::Quaterniond orientation_of(const ConstVectorView& state) {
  const Eigen::Vector3d rotation = state.segment(kRotation, 3);
  const double angle = rotation.norm();
  if (angle < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle));
}

Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& orientation) {
  const Eigen::AngleAxisd turn(orientation.w() < 0 ? Eigen::Quaterniond(-orientation.coeffs()) : orientation);
  return turn.angle() * turn.axis();
}

double uprightness(const ConstVectorView& state) { return (orientation_of(state) * Eigen::Vector3d::UnitZ()).z(); }

Vector rest() {
  Vector state = Vector::Zero(kStateSize);
  state(kPosition + 2) = kRestHeight;
  return state;
}

}  // namespace rehearse::robots::hexapod
