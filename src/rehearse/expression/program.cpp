#include "rehearse/expression/program.hpp"

#include <algorithm>

#include "rehearse/expression/slots.hpp"
#include "rehearse/expression/tape_kernel.hpp"

namespace rehearse::expression {

Program::Program(const Formulas& formulas, const std::vector<Node>& outputs)
    : tape_(formulas.builder().tape(outputs)) {}

void Program::run(const std::vector<const double*>& columns, MatrixView results) const {
  double* slots = slots_of_this_thread(tape_.slots);
  for (std::size_t i = 0; i < tape_.constants.size(); ++i)
    std::fill_n(slots + static_cast<Index>(i) * kBlock, kBlock, tape_.constants[i]);
  for (Index row = 0; row < results.rows(); row += kBlock) {
    const Index rows = std::min(kBlock, results.rows() - row);
    for (Index i = 0; i < inputs(); ++i)
      load(slots + tape_.input_slot(i) * kBlock, columns[static_cast<std::size_t>(i)] + row, rows);
    for (const auto& code : tape_.code) expression::run({code.data(), static_cast<Index>(code.size())}, {slots, rows});
    for (Index o = 0; o < outputs(); ++o) {
      const double* result = slots + tape_.outputs[static_cast<std::size_t>(o)] * kBlock;
      for (Index k = 0; k < rows; ++k) results(row + k, o) = result[k];
    }
  }
}

}  // namespace rehearse::expression
