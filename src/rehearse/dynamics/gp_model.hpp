#pragma once

#include <optional>

#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/kinematics.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/gp/posterior.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::dynamics {

enum class PredictedVariance {
  latent,  // of the latent function (Chatzilygeroudis 2018, eq. 4)
  noisy,   // plus the learned noise (the authors' code)
};

/// A prior at fixed parameters as the mean function of GPs.
struct Mean {
  prior::Prior prior;
  Vector phi;
};

/// The GP inputs of a batch: features of the states, then actions (n × (features + du)).
void gp_inputs(const FeatureMap& features, const ConstMatrixView& X, const ConstMatrixView& U, MatrixView F);
Matrix gp_inputs(const FeatureMap& features, const ConstMatrixView& X, const ConstMatrixView& U);

/// State changes = prior mean + independent GPs, those of positions after integration.hpp.
class GpModel final : public DynamicsModel {
 public:
  /// midpoint: the GPs look at the state halfway along the step that the prior predicts, or without one at positions
  /// halfway along the step that their rates predict. The forces that GPs learn act during the whole step, so that
  /// their effect is a simpler function there.
  GpModel(FeatureMap features, Kinematics kinematics, std::optional<Mean> mean, gp::Posterior posterior,
          PredictedVariance variance, bool midpoint = false)
      : features_(std::move(features)),
        kinematics_(std::move(kinematics)),
        prior_(mean ? std::optional<SimulatorModel>({std::move(mean->prior), std::move(mean->phi)}) : std::nullopt),
        posterior_(std::move(posterior)),
        variance_(variance),
        midpoint_(midpoint) {}

  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean, MatrixView variance) const override;
  void predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const override;
  /// Analytic but for the prior, whose derivatives are by differences.
  void linearise(const ConstMatrixView& X, const ConstMatrixView& U, Linearised& at) const override;

  Index rows_at_once() const override { return prior_ ? prior_->rows_at_once() : 0; }
  const Vector& measurement_std() const override { return measurement_std_; }
  /// Before the model is shared.
  void set_measurement_std(Vector std) { measurement_std_ = std::move(std); }

  const gp::Posterior& posterior() const { return posterior_; }

 private:
  struct Point;
  const Point& look_at(const ConstMatrixView& X, const ConstMatrixView& U) const;
  void finish(const Point& point, const ConstMatrixView& X, MatrixView mean) const;
  void to_states(const Point& point, const ConstMatrixView& by_inputs, const Matrix& prior_by, MatrixView by) const;

  FeatureMap features_;
  Kinematics kinematics_;
  std::optional<SimulatorModel> prior_;  // at the φ of the mean; none: the mean is 0
  gp::Posterior posterior_;
  PredictedVariance variance_;
  bool midpoint_;
  Vector measurement_std_;
};

}  // namespace rehearse::dynamics
