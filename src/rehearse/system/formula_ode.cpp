#include "rehearse/system/formula_ode.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "rehearse/core/names.hpp"
#include "rehearse/core/vector_math.hpp"
#include "rehearse/expression/formulas.hpp"
#include "rehearse/expression/slots.hpp"
#include "rehearse/system/batch.hpp"

namespace rehearse::system {
namespace {

using expression::code_of, expression::fill, expression::fill_constants, expression::kBlock, expression::load,
    expression::Node, expression::Op, expression::Pace, expression::slots_of_this_thread, expression::Tape;

/// The slopes of states as a tape. Its inputs are parameters, actions, states, and sine and cosine of each angle, which
/// are integrated with the states: (sin θ)' = cos θ θ̇.
class SlopeTape {
 public:
  explicit SlopeTape(const OdeFormulas& of)
      : states_(size(of.states)), actions_(size(of.actions)), parameters_(size(of.parameters)) {
    expression::Formulas formulas;
    for (const std::string& name : of.parameters) formulas.input(name, Pace::call);
    for (const std::string& name : of.actions) formulas.input(name, Pace::block);
    for (const std::string& name : of.states) formulas.input(name, Pace::always);
    expression::TapeBuilder& builder = formulas.builder();
    std::vector<std::pair<Node, Node>> trigonometry;
    limits_.assign(of.states.size(), kInf);
    for (Index i = 0; i < states_; ++i) {
      const std::string& name = of.states[static_cast<std::size_t>(i)];
      if (!is_among(name, of.angles)) continue;
      limits_[static_cast<std::size_t>(i)] = kLargestTurn;
      angles_.push_back(i);
      const Node sine = builder.input(Pace::always), cosine = builder.input(Pace::always);
      trigonometry.emplace_back(sine, cosine);
      builder.known_trigonometry(formulas.named(name), sine, cosine);
    }
    for (const auto& [name, formula] : of.definitions) formulas.define(name, formula);
    std::vector<Node> slopes;
    for (const std::string& formula : of.slopes) slopes.push_back(formulas.compile(formula));
    for (std::size_t a = 0; a < angles_.size(); ++a) {
      const Node rate = slopes[static_cast<std::size_t>(angles_[a])];
      const auto [sine, cosine] = trigonometry[a];
      slopes.push_back(builder.operation(Op::multiply, cosine, rate));
      slopes.push_back(builder.operation(Op::negative_multiply_add, sine, rate, builder.constant(0)));
    }
    tape_ = builder.tape(slopes);
  }

  OdeKernel sizes() const {
    return {.states = states_, .actions = actions_, .parameters = parameters_, .derivative = {}, .change = {}};
  }

  void derivative(const double* x, const double* u, const double* phi, double* dxdt) const {
    double* slots = slots_of_this_thread(tape_.slots);
    begin(slots, phi, 1);
    for (Index i = 0; i < states_; ++i) fill(slot(slots, first_state() + i), x[i], 1);
    for (Index i = 0; i < actions_; ++i) fill(slot(slots, first_action() + i), u[i], 1);
    turn(slots, 1);
    for (const Pace pace : {Pace::block, Pace::always}) expression::run(code_of(tape_, pace), {slots, 1});
    for (Index i = 0; i < states_; ++i) dxdt[i] = slots[tape_.outputs[static_cast<std::size_t>(i)] * kBlock];
  }

  void change(const ConstMatrixView& X, const ConstMatrixView& U, const double* phi, double duration_s, Index steps,
              MatrixView dX) const {
    double* slots = slots_of_this_thread(tape_.slots + 7 * integrated());
    begin(slots, phi, kBlock);
    for (Index row = 0; row < X.rows(); row += kBlock) {
      const Index rows = std::min(kBlock, X.rows() - row);
      for (Index i = 0; i < states_; ++i) load(slot(slots, first_state() + i), X.col(i).data() + row, rows);
      for (Index i = 0; i < actions_; ++i) load(slot(slots, first_action() + i), U.col(i).data() + row, rows);
      turn(slots, rows);
      expression::run(code_of(tape_, Pace::block), {slots, rows});
      const expression::BlockOde ode{code_of(tape_, Pace::always), tape_.outputs.data(), integrated(),
                                     tape_.input_slot(first_state())};
      expression::integrate(ode, {slots, rows}, slots + tape_.slots * kBlock, duration_s / static_cast<double>(steps),
                            steps);
      write_changes(slots, X.middleRows(row, rows), dX.middleRows(row, rows));
    }
  }

 private:
  static Index size(const std::vector<std::string>& names) { return static_cast<Index>(names.size()); }

  /// Inputs, in their order.
  Index first_action() const { return parameters_; }
  Index first_state() const { return parameters_ + actions_; }
  Index first_trigonometry() const { return first_state() + states_; }
  Index integrated() const { return states_ + 2 * static_cast<Index>(angles_.size()); }

  double* slot(double* slots, Index input) const { return slots + tape_.input_slot(input) * kBlock; }

  /// Constants, parameters and what follows from them alone.
  void begin(double* slots, const double* phi, Index rows) const {
    fill_constants(tape_, {slots, rows});
    for (Index i = 0; i < parameters_; ++i) fill(slot(slots, i), phi[i], rows);
    expression::run(code_of(tape_, Pace::call), {slots, rows});
  }

  void turn(double* slots, Index rows) const {
    for (std::size_t a = 0; a < angles_.size(); ++a) {
      const Index sine = first_trigonometry() + 2 * static_cast<Index>(a);
      vector_sin_cos(slot(slots, first_state() + angles_[a]), slot(slots, sine), slot(slots, sine + 1),
                     expression::whole_vectors(rows));
    }
  }

  /// Changes of a block's rows. A row that lost its way, or of which a number is not finite, is NaN as a whole.
  void write_changes(double* slots, const ConstMatrixView& X, MatrixView dX) const {
    bool failed[kBlock] = {};
    for (Index i = 0; i < states_; ++i) {
      const double *before = X.col(i).data(), *after = slot(slots, first_state() + i);
      double* change = dX.col(i).data();
      const double limit = limits_[static_cast<std::size_t>(i)];
      for (Index k = 0; k < X.rows(); ++k) {
        change[k] = after[k] - before[k];
        failed[k] |= !(std::abs(change[k]) < limit);
      }
    }
    for (Index k = 0; k < X.rows(); ++k)
      if (failed[k]) dX.row(k).setConstant(kNaN);
  }

  Index states_, actions_, parameters_;
  std::vector<Index> angles_;   // states
  std::vector<double> limits_;  // of the change of each state
  Tape tape_;
};

}  // namespace

OdeKernel formula_kernel(const OdeFormulas& formulas) {
  const auto tape = std::make_shared<const SlopeTape>(formulas);
  OdeKernel kernel = tape->sizes();
  kernel.derivative = [tape](const double* x, const double* u, const double* phi, double* dxdt) {
    tape->derivative(x, u, phi, dxdt);
  };
  kernel.change = [tape](const ConstMatrixView& X, const ConstMatrixView& U, const double* phi, double duration_s,
                         Index steps, MatrixView dX) { tape->change(X, U, phi, duration_s, steps, dX); };
  return kernel;
}

}  // namespace rehearse::system
