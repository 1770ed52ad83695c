// The cost of a prediction and of a fit against the BLAS routine that bounds them, in the same process and on one
// thread. Run with OPENBLAS_CORETYPE unset.

#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "rehearse/core/processor.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/gp/posterior.hpp"

extern "C" {
void openblas_set_num_threads(int threads);
char* openblas_get_corename();
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrmm_(const char* side, const char* uplo, const char* transa, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
}

namespace {

using namespace rehearse;

constexpr Index kInputs = 7, kOutputs = 4, kRows = 512;  // the pendubot; rows of a lockstep batch

Matrix normals(Index rows, Index columns, std::uint64_t seed) {
  Rng rng({.seed = seed});
  return Matrix::NullaryExpr(rows, columns, [&] { return rng.normal(); });
}

gp::Hyperparameters hyperparameters() {
  return {.log_lengths = Vector::LinSpaced(kInputs, 0.5, 1.5), .log_signal = 0, .log_noise = std::log(0.01)};
}

Matrix targets(const Matrix& X) {
  Matrix Y(X.rows(), kOutputs);
  for (Index e = 0; e < kOutputs; ++e)
    Y.col(e) = (X.rowwise().sum().array() * (0.3 + 0.1 * static_cast<double>(e))).sin();
  return Y + 0.01 * normals(X.rows(), kOutputs, 9);
}

gp::Posterior posterior(Index n) {
  const Matrix X = normals(n, kInputs, 1);
  return {gp::Inputs(X), targets(X), std::vector<gp::Hyperparameters>(kOutputs, hyperparameters())};
}

void count_rows(benchmark::State& state) {
  state.counters["per_row"] = benchmark::Counter(
      static_cast<double>(kRows), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Mean and variance of all outputs.
void predict(benchmark::State& state) {
  const gp::Posterior model = posterior(state.range(0));
  const Matrix F = normals(kRows, kInputs, 2);
  Matrix mean(kRows, kOutputs), variance(kRows, kOutputs);
  for (auto _ : state) model.predict(F, mean, variance);
  count_rows(state);
}
BENCHMARK(predict)->Arg(50)->Arg(200)->Arg(500)->Arg(1000);

void predict_mean(benchmark::State& state) {
  const gp::Posterior model = posterior(state.range(0));
  const Matrix F = normals(kRows, kInputs, 2);
  Matrix mean(kRows, kOutputs);
  for (auto _ : state) model.predict_mean(F, mean);
  count_rows(state);
}
BENCHMARK(predict_mean)->Arg(50)->Arg(200)->Arg(500)->Arg(1000);

/// The triangular products of `predict` by OpenBLAS, 64 columns at a time; each output has its own matrix.
void predict_dtrmm(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0)), chunk = 64;
  const std::vector<Matrix> factors(kOutputs, Matrix::Identity(n, n));  // products neither grow nor vanish
  Matrix columns = normals(n, chunk, 2);
  const double one = 1;
  for (auto _ : state)
    for (Index k = 0; k < kRows / chunk; ++k)
      for (const Matrix& L : factors) dtrmm_("L", "L", "N", "N", &n, &chunk, &one, L.data(), &n, columns.data(), &n);
  count_rows(state);
}
BENCHMARK(predict_dtrmm)->Arg(50)->Arg(200)->Arg(500)->Arg(1000);

void evidence_and_gradient(benchmark::State& state) {
  const Matrix X = normals(state.range(0), kInputs, 1);
  const gp::Inputs inputs(X);
  const Vector y = targets(X).col(0), flat = hyperparameters().flat();
  gp::Workspace workspace;
  Vector gradient;
  for (auto _ : state) benchmark::DoNotOptimize(gp::evidence(inputs, y, flat, workspace, &gradient));
}
BENCHMARK(evidence_and_gradient)->Arg(50)->Arg(200)->Arg(500)->Arg(1000)->Arg(1300)->Unit(benchmark::kMillisecond);

/// The factorisation and the inverse that the gradient needs, of the same kind of matrix.
void dpotrf_and_dpotri(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Matrix A = normals(n, n, 1);
  const Matrix K = A * A.transpose() / n + Matrix::Identity(n, n);
  Matrix work(n, n);
  int info = 0;
  for (auto _ : state) {
    state.PauseTiming();
    work = K;
    state.ResumeTiming();
    dpotrf_("L", &n, work.data(), &n, &info);
    dpotri_("L", &n, work.data(), &n, &info);
  }
}
BENCHMARK(dpotrf_and_dpotri)->Arg(50)->Arg(200)->Arg(500)->Arg(1000)->Arg(1300)->Unit(benchmark::kMillisecond);

/// One output from the default start; the second argument is the method (0 Rprop, 1 BFGS), the third whether the
/// start is the optimum for slightly different targets, as in the search over a simulator's parameters.
void fit(benchmark::State& state) {
  const Matrix X = normals(state.range(0), kInputs, 1);
  const gp::Inputs inputs(X);
  const Vector y = targets(X).col(0), before = y + 0.02 * X.col(0);
  gp::FitOptions options;
  options.method = static_cast<gp::FitMethod>(state.range(1));
  gp::Hyperparameters start = gp::default_start(inputs, y, 1);
  if (state.range(2)) start = gp::fit(inputs, before, 1, start, options).hyperparameters;
  gp::Fit result;
  for (auto _ : state) result = gp::fit(inputs, y, 1, start, options);
  state.counters["evaluations"] = static_cast<double>(result.evaluations);
  state.counters["evidence"] = result.log_evidence;
}
BENCHMARK(fit)->ArgsProduct({{200}, {0, 1}, {0, 1}})->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  openblas_set_num_threads(1);
  benchmark::AddCustomContext("blas_core", openblas_get_corename());
  benchmark::AddCustomContext("vector_target", kernel_target());
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
