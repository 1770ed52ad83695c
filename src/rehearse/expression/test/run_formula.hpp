#pragma once

#include <new>
#include <vector>

#include "rehearse/expression/formulas.hpp"
#include "rehearse/expression/slots.hpp"

namespace rehearse::expression {

/// The values of a tape's outputs (rows × outputs) at these inputs (rows × inputs), at most kBlock rows.
inline Matrix run_tape(const Tape& tape, const Matrix& inputs) {
  struct alignas(64) Slot {
    double rows[kBlock];
  };
  std::vector<Slot> slots(static_cast<std::size_t>(tape.slots));
  double* first = slots.front().rows;
  fill_constants(tape, {first, kBlock});
  for (Index i = 0; i < tape.inputs; ++i)
    for (Index k = 0; k < kBlock; ++k)
      first[tape.input_slot(i) * kBlock + k] = inputs(std::min(k, inputs.rows() - 1), i);
  for (const Pace pace : {Pace::call, Pace::block, Pace::always}) run(code_of(tape, pace), {first, inputs.rows()});
  Matrix outputs(inputs.rows(), static_cast<Index>(tape.outputs.size()));
  for (Index o = 0; o < outputs.cols(); ++o)
    for (Index k = 0; k < outputs.rows(); ++k)
      outputs(k, o) = first[tape.outputs[static_cast<std::size_t>(o)] * kBlock + k];
  return outputs;
}

/// A formula of x and y at one point.
inline double value_of(const std::string& formula, double x = 0, double y = 0) {
  Formulas formulas;
  formulas.input("x", Pace::always);
  formulas.input("y", Pace::always);
  const Node node = formulas.compile(formula);
  return run_tape(formulas.builder().tape({node}), Matrix{{x, y}})(0, 0);
}

}  // namespace rehearse::expression
