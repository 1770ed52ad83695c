#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::dynamics {

/// The learned map (states, actions) → Gaussian over state changes of one control step. Immutable; any thread.
class DynamicsModel {
 public:
  virtual ~DynamicsModel() = default;

  /// X: n × dx, U: n × du; mean, variance: n × dx, written. A row depends on that row alone up to rounding; a row
  /// that cannot be predicted is NaN in the mean. Variances are ≥ 0.
  virtual void predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
                       MatrixView variance) const = 0;

  /// The same means, without the work of the variances.
  virtual void predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const {
    Matrix variance(X.rows(), X.cols());
    predict(X, U, mean, variance);
  }

  /// A draw from the prediction, made of standard normals (n × dx).
  virtual void sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
                      MatrixView change) const;

  /// Whether all variances are 0.
  virtual bool certain() const { return false; }

  /// How many rows a call should have, as of the simulator that is asked (system::Simulator); 0: it makes no
  /// difference.
  virtual Index rows_at_once() const { return 0; }

  /// What a measurement adds to each state, as far as the data tell: a standard deviation each (dx). Empty: nothing.
  virtual const Vector& measurement_std() const {
    static const Vector nothing;
    return nothing;
  }
};

}  // namespace rehearse::dynamics
