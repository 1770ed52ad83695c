#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::dynamics {

void DynamicsModel::sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
                           MatrixView change) const {
  thread_local Matrix variance;
  variance.resize(X.rows(), X.cols());
  predict(X, U, change, variance);
  change.array() += normals.array() * variance.array().sqrt();
}

}  // namespace rehearse::dynamics
