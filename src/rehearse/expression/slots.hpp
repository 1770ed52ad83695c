#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::expression {

/// Slots of the calling thread, aligned, which keep what they hold until they are asked for again.
double* slots_of_this_thread(Index slots);

/// Fills the first `rows` numbers of a slot, and with the first of them up to a multiple of 8.
void load(double* slot, const double* from, Index rows);

}  // namespace rehearse::expression
