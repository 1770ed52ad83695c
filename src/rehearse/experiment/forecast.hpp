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

}  // namespace rehearse::experiment
