#pragma once
// The answers of a task to steps, for the sources of this room.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/core/task.hpp"

namespace rehearse::check {

/// Answers of a task to steps: states X, actions U and the states reached, a row a step.
using Answer = std::function<void(const Matrix& X, const Matrix& U, const Matrix& next, VectorView answers)>;

/// The reward and the end of the task, by their names in sentences. The task must outlive them.
std::vector<std::pair<std::string, Answer>> answers_of(const Task& task);

/// True if answers are further apart than so much of the largest.
bool differ(const Vector& one, const Vector& other, double tolerance);

/// An episode of the task that stays in a state.
Episode resting(const Task& task, const Vector& state);

}  // namespace rehearse::check
