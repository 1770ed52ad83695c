#include "rehearse/core/feature_map.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/vector_math.hpp"

namespace rehearse {

FeatureMap::FeatureMap(std::vector<StateKind> kinds, std::vector<JointAngle> joints, std::vector<Index> targets)
    : kinds_(std::move(kinds)), joints_(std::move(joints)), targets_(std::move(targets)) {
  std::vector<Index> first;  // feature of each state
  for (const StateKind kind : kinds_) {
    first.push_back(features_);
    features_ += features_of(kind);
  }
  const auto of_state = [&](Index state) {
    if (state < 0 || state >= states() || kinds_[static_cast<std::size_t>(state)] != StateKind::angle)
      throw InvalidInput(fmt::format("a joint is between two angles, but state {} is none", state));
    const Index cosine = first[static_cast<std::size_t>(state)];
    return Trigonometry{cosine, cosine + 1};
  };
  for (const JointAngle& joint : joints_) joint_features_.push_back({of_state(joint.angle), of_state(joint.parent)});
  features_ += 2 * static_cast<Index>(joints_.size());
}

void FeatureMap::apply_actions(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView F) const {
  F = U;
  for (std::size_t a = 0; a < targets_.size(); ++a)
    if (targets_[a] >= 0) F.col(static_cast<Index>(a)) -= X.col(targets_[a]);
}

std::vector<std::string> FeatureMap::names(const std::vector<std::string>& state_names) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i] == StateKind::plain) names.push_back(state_names[i]);
    if (kinds_[i] == StateKind::angle) {
      names.push_back("cos " + state_names[i]);
      names.push_back("sin " + state_names[i]);
    }
  }
  for (const JointAngle& joint : joints_) {
    const std::string angle = state_names[static_cast<std::size_t>(joint.angle)] + " - " +
                              state_names[static_cast<std::size_t>(joint.parent)];
    names.push_back("cos(" + angle + ")");
    names.push_back("sin(" + angle + ")");
  }
  return names;
}

void FeatureMap::apply(const ConstMatrixView& X, MatrixView F) const {
  Index column = 0;
  for (Index s = 0; s < states(); ++s) {
    const StateKind kind = kinds_[static_cast<std::size_t>(s)];
    if (kind == StateKind::plain) F.col(column++) = X.col(s);
    if (kind == StateKind::angle) {
      vector_sin_cos(X.col(s).data(), F.col(column + 1).data(), F.col(column).data(), X.rows());
      column += 2;
    }
  }
  for (const auto& [angle, parent] : joint_features_) {
    const auto ca = F.col(angle.cosine).array(), sa = F.col(angle.sine).array();
    const auto cb = F.col(parent.cosine).array(), sb = F.col(parent.sine).array();
    F.col(column) = ca * cb + sa * sb;
    F.col(column + 1) = sa * cb - ca * sb;
    column += 2;
  }
}

}  // namespace rehearse
