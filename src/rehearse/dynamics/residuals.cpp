#include "rehearse/dynamics/residuals.hpp"

#include <cmath>

#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/integration.hpp"

namespace rehearse::dynamics {
namespace {

Vector standard_deviations(const Matrix& Y) {
  Vector deviations(Y.cols());
  for (Index e = 0; e < Y.cols(); ++e) deviations(e) = gp::standard_deviation(Y.col(e));
  return deviations;
}

std::vector<Index> finite_rows(const Matrix& Y) {
  std::vector<Index> rows;
  for (Index i = 0; i < Y.rows(); ++i)
    if (Y.row(i).allFinite()) rows.push_back(i);
  return rows;
}

}  // namespace

Residuals::Residuals(const Dataset& data, const FeatureMap& features, Kinematics kinematics)
    : data_(data),
      kinematics_(std::move(kinematics)),
      inputs_(gp_inputs(features, data.states, data.actions)),
      all_(data.size() == 0 ? nullptr : std::make_shared<gp::Inputs>(inputs_)),
      scale_(standard_deviations(data.changes)) {}

Matrix Residuals::targets(const prior::Prior& prior, const Vector& phi) const {
  Matrix mean(data_.size(), data_.states.cols());
  prior.mean(data_.states, data_.actions, phi, mean);
  Matrix targets = data_.changes - mean;
  subtract_integrals(kinematics_, data_.states, true, targets);
  return targets;
}

Residuals::Rows Residuals::at(const prior::Prior* prior, const Vector& phi) const {
  if (!prior) {
    Matrix targets = data_.changes;
    subtract_integrals(kinematics_, data_.states, false, targets);
    return {all_, std::move(targets), 0, {}};
  }
  Matrix targets = this->targets(*prior, phi);
  if (targets.allFinite()) return {all_, std::move(targets), 0, {}};
  std::vector<Index> rows = finite_rows(targets);
  if (rows.empty()) return {nullptr, {}, size(), {}};
  return {std::make_shared<gp::Inputs>(Matrix(inputs_(rows, Eigen::all))), targets(rows, Eigen::all),
          size() - static_cast<Index>(rows.size()), std::move(rows)};
}

}  // namespace rehearse::dynamics
