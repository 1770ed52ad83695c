#include "rehearse/dynamics/actuated_model.hpp"

#include <gtest/gtest.h>

namespace rehearse::dynamics {
namespace {

/// Moves by the action, with a deviation of one tenth.
class Pushed final : public DynamicsModel {
 public:
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    mean = 0 * X;
    mean.col(0) += U.col(0);
    variance.setConstant(0.01);
  }
  Index rows_at_once() const override { return 7; }
  const Vector& measurement_std() const override { return std_; }

 private:
  Vector std_ = Vector{{0.3}};
};

const Actuators& actuators() {
  static const Actuators actuators({{.name = "u", .bounds = {-1, 1}, .actuation = {.delay_s = 0.2}}}, 0.1, 1);
  return actuators;
}

TEST(ActuatedModel, PredictsWhatFollowsFromWhatMovesTheRobot) {
  const ActuatedModel model(std::make_shared<Pushed>(), actuators());
  Matrix X(2, 3), U(2, 1), mean(2, 3), variance(2, 3), change(2, 3);
  X << 5, 0.1, 0.2, 6, 0.3, 0.4;
  U << 1, -1;
  const Matrix expected = (Matrix(2, 3) << 0.2, 0.9, -0.1, 0.4, -1.3, -0.1).finished();
  model.predict(X, U, mean, variance);
  EXPECT_TRUE(mean.isApprox(expected, 1e-14));
  EXPECT_EQ(variance, (Matrix(2, 3) << 0.01, 0, 0, 0.01, 0, 0).finished());
  mean.setZero();
  model.predict_mean(X, U, mean);
  EXPECT_TRUE(mean.isApprox(expected, 1e-14));
  const Matrix normals = Matrix::Constant(2, 3, 2);
  model.sample(X, U, normals, change);
  EXPECT_TRUE(change.leftCols(1).isApprox(expected.leftCols(1) + Matrix::Constant(2, 1, 0.2), 1e-14));
  EXPECT_TRUE(change.rightCols(2).isApprox(expected.rightCols(2), 1e-14)) << "what was sent is certain";
  EXPECT_EQ(model.measurement_std(), (Vector{{0.3, 0, 0}}));
  EXPECT_EQ(model.rows_at_once(), 7);
  EXPECT_FALSE(model.certain());
}

TEST(Moved, IsTheDataSetOfTheRobotAlone) {
  Dataset data{Matrix(2, 3), Matrix(2, 1), Matrix(2, 3), Vector{{1, 2}}};
  data.states << 5, 0.1, 0.2, 6, 0.3, 0.4;
  data.actions << 1, -1;
  data.changes << 7, 0, 0, 8, 0, 0;
  const Dataset robot = actuated(data, actuators());
  EXPECT_EQ(robot.states, (Matrix(2, 1) << 5, 6).finished());
  EXPECT_EQ(robot.actions, (Matrix(2, 1) << 0.2, 0.4).finished());
  EXPECT_EQ(robot.changes, (Matrix(2, 1) << 7, 8).finished());
  EXPECT_EQ(robot.rewards, data.rewards);
}

}  // namespace
}  // namespace rehearse::dynamics
