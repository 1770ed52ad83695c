// The pendubot's equations as formulas and as the compiled kernel of the built-in robot: changes of 256 rows.
#include <benchmark/benchmark.h>

#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/system/formula_ode.hpp"

namespace {

using namespace rehearse;

constexpr Index kRows = 256, kSubsteps = 20;

system::OdeKernel formulas() {
  return system::formula_kernel(
      {.states = {"dtheta1", "dtheta2", "theta1", "theta2"},
       .actions = {"u"},
       .parameters = {"m1", "m2", "l1", "l2", "b1", "b2"},
       .angles = {"theta1", "theta2"},
       .definitions = {{"a11", "l1^2 * (m1 / 4 + m2) + m1 * l1^2 / 12"},
                       {"a22", "l2^2 * m2 / 4 + m2 * l2^2 / 12"},
                       {"coupling", "0.5 * m2 * l1 * l2"},
                       {"a12", "coupling * cos(theta1 - theta2)"},
                       {"swing", "coupling * sin(theta1 - theta2)"},
                       {"push1", "9.82 * l1 * (0.5 * m1 + m2) * sin(theta1) + u - b1 * dtheta1 - swing * dtheta2^2"},
                       {"push2", "9.82 * 0.5 * m2 * l2 * sin(theta2) + swing * dtheta1^2 - b2 * dtheta2"},
                       {"determinant", "a11 * a22 - a12^2"}},
       .slopes = {"(a22 * push1 - a12 * push2) / determinant", "(a11 * push2 - a12 * push1) / determinant", "dtheta1",
                  "dtheta2"}});
}

void change(benchmark::State& state, const system::OdeKernel& kernel) {
  const Matrix X = 3 * Matrix::Random(kRows, 4), U = 3 * Matrix::Random(kRows, 1);
  const Vector phi{{0.5, 0.5, 0.5, 0.5, 0.1, 0.1}};
  Matrix dX(kRows, 4);
  for (auto _ : state) {
    kernel.change(X, U, phi.data(), 0.05, kSubsteps, dX);
    benchmark::DoNotOptimize(dX.data());
  }
  state.SetItemsProcessed(state.iterations() * kRows);
}

void compiled(benchmark::State& state) { change(state, robots::pendubot::kernel()); }
void as_formulas(benchmark::State& state) { change(state, formulas()); }

BENCHMARK(compiled);
BENCHMARK(as_formulas);

}  // namespace

BENCHMARK_MAIN();
