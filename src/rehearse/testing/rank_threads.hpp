#pragma once

#include <functional>

#include "rehearse/core/ranks.hpp"

namespace rehearse::testing {

/// Calls work(ranks) on `size` threads at once, each with a rank of its own: ranks without processes, to try what is
/// made for them. Returns when all have; an exception of `work` is one of the test's, and ends the program.
void on_rank_threads(int size, const std::function<void(Ranks&)>& work);

}  // namespace rehearse::testing
