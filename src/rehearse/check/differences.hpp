#pragma once
// Comparisons of predictions of the same rows, for the sources of this room.

#include <string>

#include "rehearse/core/task.hpp"

namespace rehearse::check {

/// Distances of predictions (rows × states); infinite where one of both is none.
Matrix apart(const Matrix& one, const Matrix& other);

/// Distances up to which predictions dX of states X may be the same but for rounding, one a state. A parameter that
/// cancels leaves some 1e-16 of state and change, which integration multiplies; one that changes less cannot be
/// learned.
Vector rounding(const Matrix& X, const Matrix& dX);

/// The rows and the state that are further apart than tolerated, for people; empty: there are none.
std::string difference(const Task& task, const Matrix& distances, const Vector& tolerated);

/// The first row of states X and actions U that has no prediction, and how many have none, for people; empty: all have
/// one.
std::string without_prediction(const Task& task, const Matrix& X, const Matrix& U, const Matrix& predicted);

/// The states of which a prior knows less than that nothing changes, for people: root mean square errors of a step that
/// are larger than what the step changes. as_next: those errors, if its answers were states reached instead of changes.
/// Empty: there are none.
std::string worse_than_nothing(const Task& task, const Vector& errors, const Vector& as_next, const Vector& changes);

}  // namespace rehearse::check
