#pragma once

#include <memory>
#include <string>

#include "rehearse/core/ranks.hpp"

namespace rehearse::mpi {

/// Joins the processes that mpirun or srun started with this one. Once in a process; MPI ends with the value.
std::unique_ptr<Ranks> join();

/// The cores that this process may use, and on which machine; equal where processes share them.
std::string cores();

}  // namespace rehearse::mpi
