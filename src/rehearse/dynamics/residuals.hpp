#pragma once

#include <memory>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/kinematics.hpp"
#include "rehearse/gp/inputs.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::dynamics {

/// The training data of the GPs. Targets are changes minus the prior mean and what integration.hpp subtracts; 0 for
/// states that the model of servos predicts already (servos.hpp). Rows whose prior mean is not finite are left out.
/// Const methods may run concurrently.
class Residuals {
 public:
  /// `midpoint`: see GpModel.
  explicit Residuals(const Dataset& data, FeatureMap features, Kinematics kinematics = {}, bool midpoint = false);

  struct Rows {
    std::shared_ptr<const gp::Inputs> inputs;  // null if no row is left
    Matrix targets;                            // rows × dx
    Index left_out = 0;
    std::vector<Index> kept;  // which rows of the data set; empty if none was left out
  };
  /// The rows with the prior at φ. Without a prior (null) targets are changes minus what integration.hpp subtracts.
  Rows at(const prior::Prior* prior, const Vector& phi) const;

  /// The targets of every row (n × dx); those of a row that fails are not finite.
  Matrix targets(const prior::Prior* prior, const Vector& phi) const;

  const Vector& scale() const { return scale_; }  // dx, standard deviation of the raw changes
  const Dataset& data() const { return data_; }
  const FeatureMap& features() const { return features_; }
  const Kinematics& kinematics() const { return kinematics_; }
  bool midpoint() const { return midpoint_; }
  bool predicted_by_servos(Index state) const;
  Index size() const { return data_.size(); }

  /// The residuals of other rows, with the same features, kinematics and midpoint.
  Residuals of(const Dataset& rows) const { return Residuals(rows, features_, kinematics_, midpoint_); }

 private:
  Matrix targets(const Matrix* prior_mean) const;
  Matrix prior_mean(const prior::Prior& prior, const Vector& phi) const;

  const Dataset& data_;
  FeatureMap features_;
  Kinematics kinematics_;
  bool midpoint_;
  std::shared_ptr<const gp::Inputs> without_prior_;  // of all rows
  Vector scale_;
};

/// The rows whose numbers are finite and can be squared.
std::vector<Index> finite_rows(const Matrix& Y);

}  // namespace rehearse::dynamics
