#include "rehearse/dynamics/residuals.hpp"

#include <algorithm>
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

/// The inputs of all rows without a prior; null if there is no row.
std::shared_ptr<const gp::Inputs> inputs_of(const Dataset& data, const FeatureMap& features,
                                            const Kinematics& kinematics, bool midpoint) {
  if (data.size() == 0) return nullptr;
  Matrix states = data.states;
  if (midpoint) add_half_step(kinematics, data.states, states);
  return std::make_shared<gp::Inputs>(gp_inputs(features, states, data.actions));
}

double zero_if_finite(double value) { return std::isfinite(value) ? 0 : value; }

}  // namespace

std::vector<Index> finite_rows(const Matrix& Y) {
  constexpr double kLargest = 1e150;  // whose square is a number, too
  std::vector<Index> rows;
  for (Index i = 0; i < Y.rows(); ++i)
    if ((Y.row(i).array().abs() <= kLargest).all()) rows.push_back(i);
  return rows;
}

Residuals::Residuals(const Dataset& data, FeatureMap features, Kinematics kinematics, bool midpoint)
    : data_(data),
      features_(std::move(features)),
      kinematics_(std::move(kinematics)),
      midpoint_(midpoint),
      without_prior_(inputs_of(data, features_, kinematics_, midpoint)),
      scale_(standard_deviations(data.changes(finite_rows(data.changes), Eigen::all))) {}

Matrix Residuals::prior_mean(const prior::Prior& prior, const Vector& phi) const {
  Matrix mean(data_.size(), data_.states.cols());
  prior.mean(data_.states, data_.actions, phi, mean);
  return mean;
}

/// `prior_mean`: null without a prior.
Matrix Residuals::targets(const Matrix* prior_mean) const {
  Matrix targets = data_.changes;
  if (prior_mean) targets -= *prior_mean;
  subtract_integrals(kinematics_, data_.states, prior_mean != nullptr, targets);
  for (Index state = 0; state < targets.cols(); ++state)
    if (predicted_by_servos(state)) targets.col(state) = targets.col(state).unaryExpr(&zero_if_finite);
  return targets;
}

bool Residuals::predicted_by_servos(Index state) const {
  return std::ranges::any_of(kinematics_.servos,
                             [&](const auto& servo) { return state == servo.position || state == servo.rate; });
}

Matrix Residuals::targets(const prior::Prior* prior, const Vector& phi) const {
  if (!prior) return targets(nullptr);
  const Matrix mean = prior_mean(*prior, phi);
  return targets(&mean);
}

Residuals::Rows Residuals::at(const prior::Prior* prior, const Vector& phi) const {
  Matrix mean;
  if (prior) mean = prior_mean(*prior, phi);
  Matrix targets = this->targets(prior ? &mean : nullptr);
  std::vector<Index> rows = finite_rows(targets);
  const bool all = static_cast<Index>(rows.size()) == size();
  if (all && !(prior && midpoint_)) return {without_prior_, std::move(targets), 0, {}};
  if (rows.empty()) return {nullptr, {}, size(), {}};
  Matrix states = data_.states(rows, Eigen::all);
  if (midpoint_ && prior) states += 0.5 * mean(rows, Eigen::all);
  if (midpoint_ && !prior) add_half_step(kinematics_, Matrix(states), states);
  auto inputs = std::make_shared<gp::Inputs>(gp_inputs(features_, states, data_.actions(rows, Eigen::all)));
  if (all) return {std::move(inputs), std::move(targets), 0, {}};
  return {std::move(inputs), targets(rows, Eigen::all), size() - static_cast<Index>(rows.size()), std::move(rows)};
}

}  // namespace rehearse::dynamics
