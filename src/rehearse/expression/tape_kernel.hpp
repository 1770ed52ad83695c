#pragma once

#include "rehearse/expression/tape.hpp"

namespace rehearse::expression {

inline constexpr Index kBlock = 64;  // rows that a slot holds

/// Rows that are computed where `rows` are wanted.
constexpr Index whole_vectors(Index rows) { return (rows + 7) / 8 * 8; }

/// Slots of kBlock numbers, aligned to 64 bytes. The first whole_vectors(rows) of each are computed.
/// Pointers alone: code for one instruction set instantiates nothing that the linker could take for the others' code.
struct Block {
  double* slots;
  Index rows;
};

struct Code {
  const Instruction* instructions;
  Index count;
};

void run(const Code& code, const Block& block);

/// A differential equation whose states are slots that follow each other, and whose slopes are what the code leaves in
/// the slots of `slopes`, one a state.
struct BlockOde {
  Code code;
  const std::int32_t* slopes;
  Index states;
  std::int32_t first_state;
};

/// Moves the states on by `steps` steps of h, of Dormand and Prince 1980, fifth order. work: 7 slots a state, aligned.
void integrate(const BlockOde& ode, const Block& block, double* work, double h, Index steps);

}  // namespace rehearse::expression
