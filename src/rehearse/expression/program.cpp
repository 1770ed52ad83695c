#include "rehearse/expression/program.hpp"

#include <algorithm>

#include "rehearse/expression/slots.hpp"

namespace rehearse::expression {
namespace {

/// The value of a slot as a function of the inputs: the same for all, a constant plus multiples of them, or another.
enum class Degree { constant, affine, other };

Degree product(Degree a, Degree b) {
  if (a == Degree::constant) return b;
  return b == Degree::constant ? a : Degree::other;
}

Degree degree_of(const Instruction& i, const std::vector<Degree>& slots) {
  const auto degree = [&](std::int32_t slot) { return slots[static_cast<std::size_t>(slot)]; };
  const Degree a = degree(i.a), b = arguments_of(i.op) > 1 ? degree(i.b) : Degree::constant,
               c = arguments_of(i.op) > 2 ? degree(i.c) : Degree::constant;
  switch (i.op) {
    case Op::negate:
      return a;
    case Op::add:
    case Op::subtract:
      return std::max(a, b);
    case Op::multiply:
      return product(a, b);
    case Op::divide:
      return b == Degree::constant ? a : Degree::other;
    case Op::multiply_add:
    case Op::negative_multiply_add:
      return std::max(product(a, b), c);
    default:
      return std::max({a, b, c}) == Degree::constant ? Degree::constant : Degree::other;
  }
}

}  // namespace

Program::Program(const Formulas& formulas, const std::vector<Node>& outputs)
    : tape_(formulas.builder().tape(outputs)) {}

bool Program::is_affine() const {
  std::vector<Degree> slots(static_cast<std::size_t>(tape_.slots), Degree::constant);
  for (Index i = 0; i < inputs(); ++i) slots[static_cast<std::size_t>(tape_.input_slot(i))] = Degree::affine;
  for (const std::vector<Instruction>& code : tape_.code)
    for (const Instruction& i : code) slots[static_cast<std::size_t>(i.out)] = degree_of(i, slots);
  return std::ranges::all_of(tape_.outputs,
                             [&](std::int32_t slot) { return slots[static_cast<std::size_t>(slot)] != Degree::other; });
}

void Program::run(const std::vector<const double*>& columns, MatrixView results) const {
  double* slots = slots_of_this_thread(tape_.slots);
  fill_constants(tape_, {slots, kBlock});
  for (Index row = 0; row < results.rows(); row += kBlock) {
    const Index rows = std::min(kBlock, results.rows() - row);
    for (Index i = 0; i < inputs(); ++i)
      load(slots + tape_.input_slot(i) * kBlock, columns[static_cast<std::size_t>(i)] + row, rows);
    for (const Pace pace : {Pace::call, Pace::block, Pace::always})
      expression::run(code_of(tape_, pace), {slots, rows});
    for (Index o = 0; o < outputs(); ++o) {
      const double* result = slots + tape_.outputs[static_cast<std::size_t>(o)] * kBlock;
      for (Index k = 0; k < rows; ++k) results(row + k, o) = result[k];
    }
  }
}

}  // namespace rehearse::expression
