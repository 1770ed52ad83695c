#pragma once
// Programs as simulators and as plants.

#include <memory>

#include "rehearse/core/parameters.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/program.hpp"
#include "rehearse/system/simulated_plant.hpp"
#include "rehearse/system/workers.hpp"

namespace rehearse::system {

/// A program that maps states, actions and parameters to changes of state. As many processes as there are calls at a
/// time. One that dies, hangs or answers nonsense is replaced; one that answers an error is not. Rows that it cannot
/// answer come back as NaN. Any thread.
class ProgramSimulator final : public Simulator {
 public:
  ProgramSimulator(Program program, ParameterSpace parameters);

  const ParameterSpace& parameters() const override { return parameters_; }
  /// Throws Unavailable, with why, where the program answers nothing any more.
  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override;
  Index rows_at_once() const override { return 1024; }

  Faults faults() const { return workers_.faults(); }

 private:
  ParameterSpace parameters_;
  Workers workers_;
};

/// The robot that a program is, or plays. Where it can `reset` and `step` it keeps its own state, and it measures; else
/// it is asked for changes of state by `simulator`, which knows its faults, and starts and is measured as `around`
/// says. phi: the values of the program's parameters. Throws InvalidInput, with why, where the program cannot be
/// started or is another robot's.
std::unique_ptr<Plant> make_program_plant(const Program& program, const ParameterSpace& phi,
                                          const StartAndSensors& around,
                                          std::shared_ptr<const ProgramSimulator> simulator = nullptr);

/// The use of a program: as a plant, or as a simulator, which is asked for changes of state.
enum class ProgramUse { plant, simulator };

/// Starts the program, says hello, and ends it. Throws InvalidInput with why that cannot be done, or why the program is
/// of no such use.
void require_program(const Program& program, ProgramUse use);

}  // namespace rehearse::system
