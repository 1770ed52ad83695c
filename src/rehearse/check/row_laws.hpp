#pragma once
// The law that an answer to a batch of rows depends, for each row, on that row alone, for the sources of this room.

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"

namespace rehearse::check {

/// Rows in another batch: the second half of them, in reverse.
Matrix elsewhere(const Matrix& rows);

/// A line for the reward, the end and each limit of the task that answers otherwise of the same steps a second time, or
/// in another batch. X, U, dX: states, actions and changes of steps. Rounding is allowed.
std::vector<std::string> broken_row_laws(const Task& task, const Matrix& X, const Matrix& U, const Matrix& dX);

}  // namespace rehearse::check
