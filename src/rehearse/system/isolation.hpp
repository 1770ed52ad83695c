#pragma once

#include <memory>

#include "rehearse/system/simulator.hpp"

namespace rehearse::system {

/// The simulator in processes of its own. Use it for a simulator that may end its process (by an assertion, a
/// segmentation fault) or hang. There are as many processes as calls at a time, made by fork when they are needed, and
/// ended with this object or with the program. `simulator` is called in them alone, one row at a time.
///
/// A row during which its process ends, or that takes longer than row_s, is tried once more in a new process and comes
/// back as NaN when that ends too: a process that is killed from outside changes no number. So a row that crashes costs
/// two processes, and one that hangs 2 row_s besides; the same row is not tried again in the same call. What the
/// processes print is dropped, and nothing says why a row is NaN: it is among Proposal::failed_rollouts and
/// left_out_rows alone. `change` throws Unavailable where no process can be made.
std::shared_ptr<const Simulator> isolated(std::shared_ptr<const Simulator> simulator, double row_s = 30);

}  // namespace rehearse::system
