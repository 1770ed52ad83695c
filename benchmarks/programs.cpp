// The pendubot by programs: changes of 1024 rows by one process, by NumPy in both encodings (4 steps of Runge and
// Kutta's fourth order), and the time of the way there and back alone: cat, which echoes its input.
#include <benchmark/benchmark.h>

#include "rehearse/system/process.hpp"
#include "rehearse/system/program_simulator.hpp"

namespace {

using namespace rehearse;

constexpr Index kRows = 1024;

void numpy(benchmark::State& state, const char* encoding) {
  const system::ProgramSimulator simulator(
      {.command = {"python3", REHEARSE_PROGRAMS "/pendubot.py", encoding, "4"},
       .states = {"dtheta1", "dtheta2", "theta1", "theta2"},
       .actions = {"u"},
       .parameters = {"m1", "m2", "l1", "l2", "b1", "b2"},
       .dt_s = 0.05},
      ParameterSpace({Parameter::fixed("m1", 0.5), Parameter::fixed("m2", 0.5), Parameter::fixed("l1", 0.5),
                      Parameter::fixed("l2", 0.5), Parameter::fixed("b1", 0.1), Parameter::fixed("b2", 0.1)}));
  const Matrix X = 3 * Matrix::Random(kRows, 4), U = 3 * Matrix::Random(kRows, 1);
  Matrix dX(kRows, 4);
  simulator.change(X, U, simulator.parameters().values(), dX);  // it starts
  for (auto _ : state) simulator.change(X, U, simulator.parameters().values(), dX);
  state.SetItemsProcessed(state.iterations() * kRows);
  if (simulator.faults().count > 0) state.SkipWithError(simulator.faults().last.c_str());
}

void there_and_back(benchmark::State& state) {
  const std::string message(8 * 5 * kRows, 'x');  // the numbers of so many rows
  system::Process process({"cat"}, "");
  const auto complete = [&](std::string_view text) { return text.size() < message.size() ? 0 : message.size(); };
  for (auto _ : state)
    if (process.exchange(message, complete, {}) != system::Process::Outcome::answered) state.SkipWithError("no answer");
  state.SetItemsProcessed(state.iterations() * kRows);
}

BENCHMARK_CAPTURE(numpy, doubles, "doubles")->UseRealTime();
BENCHMARK_CAPTURE(numpy, json, "json")->UseRealTime();
BENCHMARK(there_and_back)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
