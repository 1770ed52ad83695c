#pragma once

#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::experiment {

/// Errors over 1, 2, 5, 10, 20, 50, … steps, as far as the episode goes. The evaluator is asked before each step
/// whether to stop.
std::vector<ForecastError> forecast_errors(const dynamics::DynamicsModel& model, const Task& task,
                                           const Episode& episode, const Evaluator& evaluator = serial_evaluator());

/// Statistics of every state over particles (n × dx), of the values that are finite; NaN if there are none, of the
/// deviation if there is only one. A quantile is interpolated between the two nearest values.
Vector mean_of_finite(const Matrix& states);
Vector deviations_of_finite(const Matrix& states);  // their squares estimate variances without bias
Vector quantiles(const Matrix& states, double fraction);

}  // namespace rehearse::experiment
