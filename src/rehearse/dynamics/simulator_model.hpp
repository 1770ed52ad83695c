#pragma once

#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::dynamics {

/// The prior as a model: its mean, and the same variance everywhere (0: it is certain).
class SimulatorModel final : public DynamicsModel {
 public:
  SimulatorModel(prior::Prior prior, Vector phi, double variance = 0)
      : prior_(std::move(prior)), phi_(std::move(phi)), variance_(variance) {}

  void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
               MatrixView variance) const override {
    predict_mean(X, U, mean);
    variance.setConstant(variance_);
  }
  void predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const override {
    prior_.mean(X, U, phi_, mean);
  }
  bool certain() const override { return variance_ == 0; }
  Index rows_at_once() const override { return prior_.simulator->rows_at_once(); }

 private:
  prior::Prior prior_;
  Vector phi_;
  double variance_;
};

}  // namespace rehearse::dynamics
