#include "rehearse/expression/program.hpp"

#include <algorithm>

#include "rehearse/expression/slots.hpp"

namespace rehearse::expression {

Program::Program(const Formulas& formulas, const std::vector<Node>& outputs)
    : tape_(formulas.builder().tape(outputs)) {}

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
