// The cost of a model of MuJoCo as a simulator, and the share of the engine's own work: an acrobot, 256 rows.
#include <cmath>
#include <map>

#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include "rehearse/mujoco/simulator.hpp"

namespace {

using namespace rehearse;
using mujoco::State;

constexpr Index kRows = 256;

mujoco::ModelDescription acrobot(Index substeps) {
  return {.path = ACROBOT_FILE,
          .dt_s = 0.001 * static_cast<double>(substeps),
          .states = {{"a1", State::Kind::position, {{"shoulder"}}, 0},
                     {"a2", State::Kind::position, {{"shoulder"}, {"elbow"}}, 0},
                     {"da1", State::Kind::velocity, {{"shoulder"}}, 0},
                     {"da2", State::Kind::velocity, {{"shoulder"}, {"elbow"}}, 0}},
          .actions = {{"motor"}},
          .parameters = {{"m2", "kg", 0.8, {{"body", "lower", "mass"}}}}};
}

Matrix rows(Index columns) {
  Matrix numbers(kRows, columns);
  for (Index i = 0; i < numbers.size(); ++i) numbers(i) = 3 * std::sin(static_cast<double>(7 * i));
  return numbers;
}

/// All threads share the simulator, as those of a search do.
void simulator(benchmark::State& state) {
  static const auto shared = [] {
    std::map<Index, std::shared_ptr<const system::Simulator>> all;
    const ParameterSpace parameters({Parameter::fixed("m2", 0.8, "kg")});
    for (const Index n : {1, 5, 25}) all[n] = mujoco::make_simulator(mujoco::compile(acrobot(n)), parameters);
    return all;
  }();
  const Matrix X = rows(4), U = rows(1);
  Matrix dX(kRows, 4);
  for (auto _ : state) {
    shared.at(state.range(0))->change(X, U, Vector{{0.8}}, dX);
    benchmark::DoNotOptimize(dX.data());
  }
  state.SetItemsProcessed(state.iterations() * kRows);
}

/// The same rows by the engine alone.
void engine(benchmark::State& state) {
  mjModel* const model = mj_loadXML(ACROBOT_FILE, nullptr, nullptr, 0);
  mjData* const data = mj_makeData(model);
  const Matrix X = rows(4), U = rows(1);
  for (auto _ : state) {
    for (Index i = 0; i < kRows; ++i) {
      for (Index j = 0; j < 2; ++j) data->qpos[j] = X(i, j), data->qvel[j] = X(i, 2 + j);
      data->ctrl[0] = U(i);
      for (Index s = 0; s < state.range(0); ++s) mj_step(model, data);
    }
    benchmark::DoNotOptimize(data->qpos);
  }
  state.SetItemsProcessed(state.iterations() * kRows);
  mj_deleteData(data);
  mj_deleteModel(model);
}

BENCHMARK(engine)->ArgName("substeps")->Arg(1)->Arg(5)->Arg(25)->UseRealTime();
BENCHMARK(engine)->ArgName("substeps")->Arg(25)->Threads(2)->UseRealTime();
BENCHMARK(simulator)->ArgName("substeps")->Arg(1)->Arg(5)->Arg(25)->UseRealTime();
BENCHMARK(simulator)->ArgName("substeps")->Arg(25)->Threads(2)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
