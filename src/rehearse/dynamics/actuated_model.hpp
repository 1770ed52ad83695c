#pragma once
// Models of a robot's own states, with its actuators in front (core/actuators.hpp).

#include <memory>

#include "rehearse/core/actuators.hpp"
#include "rehearse/core/episode.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::dynamics {

/// The data set of the robot's own states, with what moved it for actions.
Dataset actuated(const Dataset& data, const Actuators& actuators);

/// A model of the states with their memory: the robot's predicts what follows from what moves it. The memory is
/// certain. Immutable; any thread.
class ActuatedModel final : public DynamicsModel {
 public:
  ActuatedModel(std::shared_ptr<const DynamicsModel> robot, Actuators actuators);

  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean, MatrixView variance) const override;
  void predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const override;
  void sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
              MatrixView change) const override;
  bool certain() const override { return robot_->certain(); }
  Index rows_at_once() const override { return robot_->rows_at_once(); }
  const Vector& measurement_std() const override { return measurement_std_; }

 private:
  const Matrix& moving(const ConstMatrixView& X, const ConstMatrixView& U) const;
  void remember(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView change) const;

  std::shared_ptr<const DynamicsModel> robot_;
  Actuators actuators_;
  Vector measurement_std_;
};

}  // namespace rehearse::dynamics
