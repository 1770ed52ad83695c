#pragma once

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::lqr {

/// The model and the task that are planned on. References must outlive it.
struct Problem {
  const dynamics::DynamicsModel& model;
  const Task& task;  // its start's spread is not used
  const Evaluator& evaluator;
};

}  // namespace rehearse::lqr
