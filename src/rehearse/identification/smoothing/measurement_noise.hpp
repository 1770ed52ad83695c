#pragma once

#include "rehearse/core/episode.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::identification {

/// The noise of measurements that would explain what a model of state changes takes for noise: a standard deviation a
/// state (dx). `noise_variances`: of the model's dx outputs. With f the mean prediction, a measured change is
/// f(x + ε) + ε' − (∂f/∂x + I) ε to first order, where ε and ε' are of the variances s, so that the noise of output e
/// is s_e + Σ_d E[(∂f_e/∂x_d + δ_ed)²] s_d: solved for s ≥ 0, equations weighted by the noise (the heteroscedastic part
/// of McHutchon 2011 averaged over at most 64 rows of the data set). Slopes are differences of predictions.
Vector measurement_std(const dynamics::DynamicsModel& model, const Dataset& data, const Vector& noise_variances);

}  // namespace rehearse::identification
