#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::dynamics {

/// Predictions of n rows, and their derivatives by inputs: states first, then actions.
struct Linearised {
  Matrix mean, variance;        // n × dx
  Matrix mean_by, variance_by;  // n × dx·(dx+du): column i·(dx+du) + j holds that of output i by input j

  void resize(Index rows, Index states, Index actions);
};

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

  /// The predictions and their derivatives, by central differences of `predict` unless a model overrides it. A row that
  /// cannot be predicted, or not beside it, has NaN where that matters. No allocation if `at` had the same size before.
  virtual void linearise(const ConstMatrixView& X, const ConstMatrixView& U, Linearised& at) const;

  /// A draw from the prediction, made of standard normals (n × dx).
  virtual void sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
                      MatrixView change) const;

  /// True if all variances are 0.
  virtual bool certain() const { return false; }

  /// The number of rows a call should have, as for a simulator (system::Simulator); 0: it makes no difference.
  virtual Index rows_at_once() const { return 0; }

  /// The measurement noise of each state estimated from the data: standard deviations (dx). Empty: none.
  virtual const Vector& measurement_std() const {
    static const Vector nothing;
    return nothing;
  }
};

}  // namespace rehearse::dynamics
