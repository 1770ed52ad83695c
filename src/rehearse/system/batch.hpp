#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::system {

inline constexpr double kLargestTurn = 30000;  // rad in a control step; a simulation that turns further has diverged

/// States, actions and changes of as many rows, column-major, columns a stride apart. Numbers and pointers alone: code
/// for one instruction set instantiates nothing of Eigen, which the linker could take for the others' code, too.
struct Batch {
  const double* X;  // rows × dx
  Index x_stride;
  const double* U;  // rows × du
  Index u_stride;
  double* dX;  // rows × dx
  Index dx_stride;
  Index rows;
};

}  // namespace rehearse::system
