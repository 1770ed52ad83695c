#pragma once

#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// The way a state variable enters the inputs of models and policies.
enum class StateKind {
  plain,    // as it is
  angle,    // as its cosine and sine, in this order
  omitted,  // not at all (a translation that the dynamics does not depend on)
};

/// The number of inputs that a state of this kind has.
inline Index features_of(StateKind kind) { return kind == StateKind::angle ? 2 : kind == StateKind::plain ? 1 : 0; }

/// The angle between a link and the one that carries it: angle − parent. Both are states of kind angle.
struct JointAngle {
  Index angle = 0, parent = 0;
};

/// States → inputs of GPs and policies, state by state in order; then cosine and sine of each joint's angle. A value;
/// any thread.
class FeatureMap {
 public:
  FeatureMap() = default;
  /// Throws InvalidInput if a joint's states are not angles.
  /// targets: of each action the state that it is a target of (a servo's), −1 for none; empty: none.
  explicit FeatureMap(std::vector<StateKind> kinds, std::vector<JointAngle> joints = {},
                      std::vector<Index> targets = {});

  Index states() const { return static_cast<Index>(kinds_.size()); }
  Index features() const { return features_; }
  const std::vector<StateKind>& kinds() const { return kinds_; }
  const std::vector<JointAngle>& joints() const { return joints_; }
  const std::vector<Index>& targets() const { return targets_; }
  std::vector<std::string> names(const std::vector<std::string>& state_names) const;

  /// X: rows × states, F: rows × features.
  void apply(const ConstMatrixView& X, MatrixView F) const;
  /// Writes actions U to F (both rows × du) as models take them: those that are targets count from the state.
  void apply_actions(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView F) const;

 private:
  struct Trigonometry {
    Index cosine, sine;  // features
  };
  struct Joint {
    Trigonometry angle, parent;
  };

  std::vector<StateKind> kinds_;
  std::vector<JointAngle> joints_;
  std::vector<Joint> joint_features_;
  std::vector<Index> targets_;
  Index features_ = 0;
};

}  // namespace rehearse
