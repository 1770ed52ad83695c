#pragma once

#include <functional>
#include <memory>
#include <string>

#include "rehearse/core/ranks.hpp"

namespace rehearse::mpi {

/// Joins the processes that mpirun or srun started with this one. Once in a process; MPI ends with the value.
/// stop: whether this process was asked to stop.
std::unique_ptr<Ranks> join(std::function<bool()> stop);

/// The cores that this process may use, and on which machine; equal where processes share them.
std::string cores();

}  // namespace rehearse::mpi
