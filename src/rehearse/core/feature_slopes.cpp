#include "rehearse/core/feature_slopes.hpp"

namespace rehearse {

void pull_back_features(const FeatureMap& map, const ConstMatrixView& F, const ConstMatrixView& by_features,
                        MatrixView by_states) {
  const auto by_angle = [&](Index cosine) {
    return by_features.col(cosine + 1).array() * F.col(cosine).array() -
           by_features.col(cosine).array() * F.col(cosine + 1).array();
  };
  Index column = 0;
  for (Index s = 0; s < map.states(); ++s) {
    const StateKind kind = map.kinds()[static_cast<std::size_t>(s)];
    if (kind == StateKind::omitted) by_states.col(s).setZero();
    if (kind == StateKind::plain) by_states.col(s) = by_features.col(column++);
    if (kind != StateKind::angle) continue;
    by_states.col(s) = by_angle(column);
    column += 2;
  }
  for (const JointAngle& joint : map.joints()) {
    by_states.col(joint.angle).array() += by_angle(column);
    by_states.col(joint.parent).array() -= by_angle(column);
    column += 2;
  }
}

void pull_back_targets(const FeatureMap& map, const ConstMatrixView& by_actions, MatrixView by_states) {
  for (std::size_t a = 0; a < map.targets().size(); ++a)
    if (map.targets()[a] >= 0) by_states.col(map.targets()[a]) -= by_actions.col(static_cast<Index>(a));
}

}  // namespace rehearse
