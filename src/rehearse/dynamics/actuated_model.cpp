#include "rehearse/dynamics/actuated_model.hpp"

#include <utility>

namespace rehearse::dynamics {

Dataset actuated(const Dataset& data, const Actuators& actuators) {
  const Index own = actuators.own_states();
  Dataset robot{data.states.leftCols(own), Matrix(data.actions.rows(), data.actions.cols()), data.changes.leftCols(own),
                data.rewards};
  actuators.moving(data.states, data.actions, robot.actions);
  return robot;
}

ActuatedModel::ActuatedModel(std::shared_ptr<const DynamicsModel> robot, Actuators actuators)
    : robot_(std::move(robot)), actuators_(std::move(actuators)), measurement_std_(robot_->measurement_std()) {
  if (measurement_std_.size() == 0) return;
  measurement_std_.conservativeResize(actuators_.states());
  measurement_std_.tail(actuators_.memory()).setZero();
}

const Matrix& ActuatedModel::moving(const ConstMatrixView& X, const ConstMatrixView& U) const {
  thread_local Matrix moving;
  moving.resize(U.rows(), U.cols());
  actuators_.moving(X, U, moving);
  return moving;
}

void ActuatedModel::remember(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView change) const {
  actuators_.remember(X, U, change);
  change.rightCols(actuators_.memory()) -= X.rightCols(actuators_.memory());
}

void ActuatedModel::predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
                            MatrixView variance) const {
  const Index own = actuators_.own_states();
  robot_->predict(X.leftCols(own), moving(X, U), mean.leftCols(own), variance.leftCols(own));
  remember(X, U, mean);
  variance.rightCols(actuators_.memory()).setZero();
}

void ActuatedModel::predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const {
  const Index own = actuators_.own_states();
  robot_->predict_mean(X.leftCols(own), moving(X, U), mean.leftCols(own));
  remember(X, U, mean);
}

void ActuatedModel::sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
                           MatrixView change) const {
  const Index own = actuators_.own_states();
  robot_->sample(X.leftCols(own), moving(X, U), normals.leftCols(own), change.leftCols(own));
  remember(X, U, change);
}

}  // namespace rehearse::dynamics
