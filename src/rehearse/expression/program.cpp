#include "rehearse/expression/program.hpp"

#include <algorithm>

#include "rehearse/expression/slots.hpp"

namespace rehearse::expression {
namespace {

int product(int a, int b) { return std::min(a + b, Program::kNoPolynomial); }

/// before: of the instruction before.
int degree_of(const Instruction& i, const std::vector<int>& slots, int before) {
  const auto degree = [&](Argument argument, std::int32_t slot) {
    if (argument == i.in_registers) return before;
    return static_cast<int>(argument) <= arguments_of(i.op) ? slots[static_cast<std::size_t>(slot)] : 0;
  };
  const int a = degree(Argument::a, i.a), b = degree(Argument::b, i.b), c = degree(Argument::c, i.c);
  switch (i.op) {
    case Op::negate:
      return a;
    case Op::add:
    case Op::subtract:
      return std::max(a, b);
    case Op::multiply:
      return product(a, b);
    case Op::divide:
      return b == 0 ? a : Program::kNoPolynomial;
    case Op::multiply_add:
    case Op::negative_multiply_add:
      return std::max(product(a, b), c);
    default:
      return std::max({a, b, c}) == 0 ? 0 : Program::kNoPolynomial;
  }
}

}  // namespace

Program::Program(const Formulas& formulas, const std::vector<Node>& outputs)
    : tape_(formulas.builder().tape(outputs)) {}

int Program::degree() const {
  std::vector<int> slots(static_cast<std::size_t>(tape_.slots), 0);
  for (Index i = 0; i < inputs(); ++i) slots[static_cast<std::size_t>(tape_.input_slot(i))] = 1;
  for (const std::vector<Instruction>& code : tape_.code) {
    int before = 0;
    for (const Instruction& i : code) {
      before = degree_of(i, slots, before);
      if (i.is_stored) slots[static_cast<std::size_t>(i.out)] = before;
    }
  }
  int degree = 0;
  for (const std::int32_t slot : tape_.outputs) degree = std::max(degree, slots[static_cast<std::size_t>(slot)]);
  return degree;
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
