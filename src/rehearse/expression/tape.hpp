#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::expression {

enum class Op : std::uint8_t {
  // of one number
  negate,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  exponential,
  logarithm,
  square_root,
  absolute,
  sign,
  round_down,
  round_up,
  logical_not,
  // of two
  add,
  subtract,
  multiply,
  divide,
  power,
  arctangent2,
  minimum,
  maximum,
  less,
  less_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  // of three
  multiply_add,           // a b + c, rounded once
  negative_multiply_add,  // c − a b, rounded once
  where,                  // b where a is not 0, else c
};

/// The number of arguments of an operation.
constexpr int arguments_of(Op op) { return op >= Op::multiply_add ? 3 : op >= Op::add ? 2 : 1; }

/// Operations whose result stays in registers until the next instruction, which may take it from there.
constexpr bool stays_in_registers(Op op) {
  return op == Op::negate || (op >= Op::add && op <= Op::divide) || op == Op::multiply_add ||
         op == Op::negative_multiply_add;
}

/// An argument of an instruction, by its place.
enum class Argument : std::uint8_t { none, a, b, c };

/// out = op(a, b, c), numbers of slots; those that the operation does not take are 0.
struct Instruction {
  Op op;
  Argument in_registers = Argument::none;  // it is the result of the instruction before, whatever its slot holds
  bool is_stored = true;                   // false: the next instruction alone needs the result, and `out` is 0
  std::int32_t out = 0, a = 0, b = 0, c = 0;
};

/// The rate at which an input changes; a value is computed when the fastest of its inputs changes.
enum class Pace : std::uint8_t { call, block, always };

/// Formulas as a list of instructions. Slots hold constants, then inputs, then what instructions write.
struct Tape {
  std::vector<double> constants;
  Index inputs = 0;
  std::vector<Instruction> code[3];   // by pace
  std::vector<std::int32_t> outputs;  // slots
  Index slots = 0;

  std::int32_t input_slot(Index input) const {
    return static_cast<std::int32_t>(constants.size() + static_cast<std::size_t>(input));
  }
  std::int32_t slots_of_inputs() const { return input_slot(inputs); }  // and of constants
};

}  // namespace rehearse::expression
