// The time and the result of learning a model, against its plain alternatives: fits of four kernels against 300
// iterations of Rprop, GP-MI's alternating search against the nested one of the paper, scores against each other. Data
// are episodes of random policies on the pendubot. Each is run once: every repetition does the same work.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "cpu_time.hpp"
#include "episodes.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"

namespace {

using namespace rehearse;
using benchmarks::random_episodes;

scenario::Scenario pendubot(double noise) {
  robots::pendubot::Options options;
  options.ode.measurement_noise = noise;
  return robots::pendubot::make(options);
}

/// The data and the prior of a learning problem.
struct Problem {
  Problem(const char* prior_name, Index rows, bool noise, std::uint64_t seed) : scenario(pendubot(noise ? 0.01 : 0)) {
    data = random_episodes(scenario, rows, seed);
    for (const auto& named : scenario.priors)
      if (named.name == prior_name) prior = prior::Prior{named.name, named.simulator, named.parameters};
  }
  identification::Learned learn(const identification::Kind& kind, const Evaluator& evaluator) const {
    return identification::learn(
        {data, scenario.task.model_features(), scenario.task.kinematics(), prior ? &*prior : nullptr}, kind, {},
        evaluator);
  }

  scenario::Scenario scenario;
  Dataset data;
  std::optional<prior::Prior> prior;
};

/// The largest of the masses' and lengths' errors, as a fraction of the truth (0.5 each).
double error_of(const identification::Learned& learned) {
  return (learned.state.phi->head(4).array() - 0.5).abs().maxCoeff() / 0.5;
}

/// Learns once; the counters say what was reached.
void learn(benchmark::State& state, const identification::Kind& kind, const char* prior, int threads) {
  const Problem problem(prior, state.range(0), state.range(1) != 0, 1);
  const auto evaluator = make_thread_evaluator(threads);
  identification::Learned learned;
  for (auto _ : state) learned = problem.learn(kind, *evaluator);
  state.counters["evidence"] = *learned.log_evidence;
  if (!std::holds_alternative<identification::GpMi>(kind)) return;
  state.counters["evaluations"] = static_cast<double>(learned.evaluations);
  state.counters["error"] = error_of(learned);
}

/// Four kernels. 1: as by default; 0: as the authors, 300 iterations of Rprop from one start.
void fit(benchmark::State& state) {
  identification::ZeroMean kind;
  kind.gp.tolerance = 0;  // of the prediction, which is not measured here
  kind.gp.fit.penalties = {};
  if (state.range(2) == 0) {
    kind.gp.fit.method = gp::FitMethod::rprop;
    kind.gp.fit.rprop.max_evaluations = 300;
    kind.gp.fit.starts = 1;
    kind.gp.fit.part_rows = 0;
  }
  learn(state, kind, "", 1);
}
BENCHMARK(fit)
    ->ArgNames({"rows", "noise", "default"})
    ->ArgsProduct({{200, 500, 1000}, {0, 1}, {0, 1}})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

void gp_mi(benchmark::State& state, const char* prior, identification::PhiSearch search, int threads) {
  identification::GpMi kind;
  kind.search = search;
  learn(state, kind, prior, threads);
}

/// The result of a search: the score, the error of φ, the time.
struct Reached {
  double score, error, cpu_s;
};

Reached reach(const Problem& problem, identification::GpMi kind, identification::PhiSearch search) {
  kind.search = search;
  const double start = benchmarks::cpu_s();
  const identification::Learned learned = problem.learn(kind, serial_evaluator());
  return {learned.score.value(), error_of(learned), benchmarks::cpu_s() - start};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Both searches on the data of `kSeeds` seeds. Counters: in how many the alternating one ends lower (by 0.01 nat), the
/// median of how much higher it ends, the median of how many times faster it is, and errors of φ.
void searches(benchmark::State& state, const char* prior) {
  constexpr int kSeeds = 5;
  identification::GpMi kind;
  kind.score = static_cast<identification::Score>(state.range(2));
  std::vector<double> gains, speedups, errors, nested_errors;
  for (auto _ : state)
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const Problem problem(prior, state.range(0), state.range(1) != 0, static_cast<std::uint64_t>(seed));
      const Reached nested = reach(problem, kind, identification::PhiSearch::nested);
      const Reached alternating = reach(problem, kind, identification::PhiSearch::alternating);
      gains.push_back(alternating.score - nested.score);
      speedups.push_back(nested.cpu_s / alternating.cpu_s);
      errors.push_back(alternating.error);
      nested_errors.push_back(nested.error);
    }
  state.counters["lower"] =
      static_cast<double>(std::count_if(gains.begin(), gains.end(), [](double g) { return g < -0.01; }));
  state.counters["gain"] = median(gains);
  state.counters["least_gain"] = *std::min_element(gains.begin(), gains.end());
  state.counters["speedup"] = median(speedups);
  state.counters["error"] = median(errors);
  state.counters["nested_error"] = median(nested_errors);
}

void register_searches() {
  for (const char* prior : {"misleading", "partial"})
    benchmark::RegisterBenchmark(("searches/" + std::string(prior)).c_str(), searches, prior)
        ->ArgNames({"rows", "noise", "score"})  // 0 sum, 1 product, 2 harmonic mean
        ->ArgsProduct({{50, 100, 200}, {0, 1}, {0, 1, 2}})
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
}

void register_gp_mi() {
  const struct {
    const char* name;
    identification::PhiSearch search;
    int threads;
    std::vector<std::int64_t> rows;
  } cases[] = {{"alternating", identification::PhiSearch::alternating, 1, {50, 100, 200, 400, 800, 1300, 2000, 3000}},
               {"alternating", identification::PhiSearch::alternating, 2, {200, 1300}},
               {"nested", identification::PhiSearch::nested, 1, {50, 100, 200, 400}},
               {"nested", identification::PhiSearch::nested, 2, {1300}}};
  for (const auto& c : cases)
    for (const char* prior : {"misleading", "partial"})
      benchmark::RegisterBenchmark(
          ("gp_mi/" + std::string(prior) + "/" + c.name + "/threads:" + std::to_string(c.threads)).c_str(), gp_mi,
          prior, c.search, c.threads)
          ->ArgNames({"rows", "noise"})
          ->ArgsProduct({c.rows, {0, 1}})
          ->Iterations(1)
          ->MeasureProcessCPUTime()
          ->UseRealTime()
          ->Unit(benchmark::kSecond);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("vector_target", kernel_target());
  register_gp_mi();
  register_searches();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
