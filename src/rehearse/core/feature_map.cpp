#include "rehearse/core/feature_map.hpp"

#include "rehearse/core/vector_math.hpp"

namespace rehearse {

FeatureMap::FeatureMap(std::vector<StateKind> kinds) : kinds_(std::move(kinds)) {
  for (StateKind kind : kinds_) features_ += kind == StateKind::angle ? 2 : kind == StateKind::plain ? 1 : 0;
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
}

}  // namespace rehearse
