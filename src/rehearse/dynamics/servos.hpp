#pragma once
// A model of servos that reach their targets late or not at all. A simulator of rigid bodies is often right about what
// moving joints do to the robot, and wrong about how far they move in a step: torque, friction and delays are hard to
// measure. Therefore GPs learn the joints' positions at the end of a step, and the prior predicts what follows from
// these.

#include <memory>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/kinematics.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/dynamics/gp_options.hpp"
#include "rehearse/gp/posterior.hpp"

namespace rehearse::dynamics {

/// The data set with targets replaced by the positions that the servos reached.
Dataset reached(Dataset data, const std::vector<Kinematics::Servo>& servos);

/// A model of the servos' positions and speeds at the end of a step. GPs that the servos of a type share predict the
/// way beyond the target and the speed, from the servo's way to the target, speed and position. GPs of each servo learn
/// what these leave, the load above all, from the whole state, near what was tried. A servo that hardly moved in the
/// data stays where it is. Immutable; any thread.
class Servos {
 public:
  /// Throws InvalidInput if the data set has no row.
  Servos(const Dataset& data, FeatureMap features, const std::vector<Kinematics::Servo>& servos,
         const GpOptions& options, const Evaluator& evaluator);

  /// States of servos at the end of a step, with the GPs' variances.
  struct End {
    Matrix positions, speeds, position_variances, speed_variances;  // n × du; nothing where an action moves no servo
  };
  /// Predicts means alone, without the work of variances: `end` has none.
  void means(const ConstMatrixView& X, const ConstMatrixView& U, End& end) const;
  void predict(const ConstMatrixView& X, const ConstMatrixView& U, End& end) const;

  /// Replaces the targets in actions by the predicted positions of the servos.
  void replace_targets(const End& end, MatrixView U) const;

  const std::vector<Kinematics::Servo>& servos() const { return servos_; }
  double log_evidence() const { return log_evidence_; }  // nats

 private:
  struct Type {
    std::vector<Kinematics::Servo> servos;
    std::shared_ptr<const gp::Posterior> posterior;  // null: they stay where they are
  };
  void learn_types(const Dataset& data, const GpOptions& options, const Evaluator& evaluator);
  void learn_rest(const Dataset& data, const GpOptions& options, const Evaluator& evaluator);
  template <class Visit>
  void for_each_moving(Visit visit) const;
  void forward(const ConstMatrixView& X, const ConstMatrixView& U, bool variances, End& end) const;

  FeatureMap features_;
  std::vector<Kinematics::Servo> servos_;
  PredictedVariance variance_;
  std::vector<Type> types_;
  std::shared_ptr<const gp::Posterior> rest_;  // of each servo that moves, in order; null if none does
  double log_evidence_ = 0;
};

/// The servos, followed by a model of the robot given their positions. A draw of the servos moves the robot with them.
class ServoModel final : public DynamicsModel {
 public:
  ServoModel(std::shared_ptr<const Servos> servos, std::shared_ptr<const DynamicsModel> body)
      : servos_(std::move(servos)), body_(std::move(body)) {}

  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean, MatrixView variance) const override;
  void predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const override;
  void sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
              MatrixView change) const override;
  const Vector& measurement_std() const override { return body_->measurement_std(); }
  Index rows_at_once() const override { return body_->rows_at_once(); }

 private:
  std::shared_ptr<const Servos> servos_;
  std::shared_ptr<const DynamicsModel> body_;
};

}  // namespace rehearse::dynamics
