#pragma once

#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// How a state variable enters the inputs of models and policies.
enum class StateKind {
  plain,    // as it is
  angle,    // as its cosine and sine, in this order
  omitted,  // not at all (a translation that the dynamics does not depend on)
};

/// States → inputs of GPs and policies, state by state in order. A value; any thread.
class FeatureMap {
 public:
  FeatureMap() = default;
  explicit FeatureMap(std::vector<StateKind> kinds);

  Index states() const { return static_cast<Index>(kinds_.size()); }
  Index features() const { return features_; }
  const std::vector<StateKind>& kinds() const { return kinds_; }
  std::vector<std::string> names(const std::vector<std::string>& state_names) const;

  /// X: rows × states, F: rows × features.
  void apply(const ConstMatrixView& X, MatrixView F) const;

 private:
  std::vector<StateKind> kinds_;
  Index features_ = 0;
};

}  // namespace rehearse
