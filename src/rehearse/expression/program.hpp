#pragma once

#include <string>
#include <vector>

#include "rehearse/expression/formulas.hpp"

namespace rehearse::expression {

/// Formulas that are computed for many rows at once. Use it for rewards and conditions. Immutable; any thread.
class Program {
 public:
  Program() = default;
  /// `outputs` of the formulas; all inputs of the formulas are inputs here, in the order in which they were made.
  Program(const Formulas& formulas, const std::vector<Node>& outputs);

  /// The largest degree of the outputs as polynomials of the inputs, as they are written: 0 of constants, 1 where all
  /// else is multiples of inputs, 2 of their products; kNoPolynomial of more, and of all else, such as x * x / x.
  int degree() const;
  static constexpr int kNoPolynomial = 3;

  Index inputs() const { return tape_.inputs; }
  Index outputs() const { return static_cast<Index>(tape_.outputs.size()); }

  /// columns: of each input its numbers, one a row. results: rows × outputs.
  void run(const std::vector<const double*>& columns, MatrixView results) const;

 private:
  Tape tape_;
};

}  // namespace rehearse::expression
