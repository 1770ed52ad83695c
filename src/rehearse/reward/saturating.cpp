#include "rehearse/reward/saturating.hpp"

#include "rehearse/core/vector_math.hpp"

namespace rehearse::reward {

Reward saturating(SquaredDistance squared_distance, double width) {
  return [squared_distance = std::move(squared_distance), factor = -0.5 / (width * width)](
             const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView& X_next, VectorView rewards) {
    squared_distance(X_next, rewards);
    rewards *= factor;
    vector_exp(rewards.data(), rewards.data(), rewards.size());
  };
}

}  // namespace rehearse::reward
