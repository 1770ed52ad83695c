#pragma once

#include "rehearse/expression/tape_kernel.hpp"

namespace rehearse::expression {

/// Aligned slots of the calling thread; their contents last until the next call.
double* slots_of_this_thread(Index slots);

/// Fills the first `rows` numbers of a slot, and with the first of them up to whole vectors.
void load(double* slot, const double* from, Index rows);

/// The same value in `rows` rows, up to whole vectors.
void fill(double* slot, double value, Index rows);

/// Writes a tape's constants into their slots.
void fill_constants(const Tape& tape, const Block& block);

/// The instructions of one pace.
Code code_of(const Tape& tape, Pace pace);

}  // namespace rehearse::expression
