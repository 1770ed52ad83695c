// Products and factorisations of core/linear_algebra.hpp against OpenBLAS's: `linear_algebra_benchmark`, with
// OPENBLAS_CORETYPE unset, which would choose other kernels than this processor's.

#include "rehearse/core/linear_algebra.hpp"

#include <benchmark/benchmark.h>

#include "rehearse/core/processor.hpp"
#include "rehearse/core/random.hpp"

extern "C" {
void openblas_set_num_threads(int threads);
char* openblas_get_corename();
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}

namespace {

using namespace rehearse;

Matrix normals(Index rows, Index columns) {
  Rng rng({.seed = 1});
  Matrix X(rows, columns);
  for (double& x : X.reshaped()) x = rng.normal();
  return X;
}

Matrix positive_definite(Index n) {
  const Matrix A = normals(n, n);
  return product(A, A.transpose()) / static_cast<double>(n) + Matrix::Identity(n, n);
}

constexpr int kColumns = 34;
constexpr double kOne = 1;

void flops(benchmark::State& state, double each) {
  state.counters["flops"] = benchmark::Counter(each, benchmark::Counter::kIsIterationInvariantRate);
}

/// C += A B with A square and few columns of B.
template <class Call>
void multiply(benchmark::State& state, const Call& call) {
  const Index n = state.range(0);
  const Matrix A = normals(n, n), B = normals(n, kColumns);
  Matrix C = Matrix::Zero(n, kColumns);
  for (auto _ : state) call(A, B, C), benchmark::ClobberMemory();
  flops(state, 2.0 * static_cast<double>(n * n * kColumns));
}
void product(benchmark::State& state) {
  multiply(state, [](const Matrix& A, const Matrix& B, Matrix& C) { add_product(C, Sign::plus, A, B); });
}
void product_openblas(benchmark::State& state) {
  multiply(state, [](const Matrix& A, const Matrix& B, Matrix& C) {
    const int n = static_cast<int>(A.rows()), columns = kColumns;
    dgemm_("N", "N", &n, &columns, &n, &kOne, A.data(), &n, B.data(), &n, &kOne, C.data(), &n);
  });
}

template <class Call>
void factorise(benchmark::State& state, const Call& call) {
  const Index n = state.range(0);
  const Matrix A = positive_definite(n);
  Matrix L;
  for (auto _ : state) L = A, call(L);
  flops(state, static_cast<double>(n * n * n) / 3);
}
void cholesky(benchmark::State& state) {
  factorise(state, [](Matrix& L) { rehearse::cholesky(L); });
}
void cholesky_openblas(benchmark::State& state) {
  factorise(state, [](Matrix& L) {
    const int n = static_cast<int>(L.rows());
    int info = 0;
    dpotrf_("L", &n, L.data(), &n, &info);
  });
}

/// L⁻¹ B with as many columns as rows.
template <class Call>
void divide(benchmark::State& state, const Call& call) {
  const Index n = state.range(0);
  Matrix L = positive_definite(n), X;
  rehearse::cholesky(L);
  const Matrix B = normals(n, n);
  for (auto _ : state) X = B, call(L, X);
  flops(state, static_cast<double>(n * n * n));
}
void solve(benchmark::State& state) {
  divide(state, [](const Matrix& L, Matrix& X) { solve_lower(L, X); });
}
void solve_openblas(benchmark::State& state) {
  divide(state, [](const Matrix& L, Matrix& X) {
    const int n = static_cast<int>(L.rows());
    dtrsm_("L", "L", "N", "N", &n, &n, &kOne, L.data(), &n, X.data(), &n);
  });
}

BENCHMARK(product)->Arg(81)->Arg(300)->Arg(1400);
BENCHMARK(product_openblas)->Arg(81)->Arg(300)->Arg(1400);
BENCHMARK(cholesky)->Arg(81)->Arg(300)->Arg(1400);
BENCHMARK(cholesky_openblas)->Arg(81)->Arg(300)->Arg(1400);
BENCHMARK(solve)->Arg(81)->Arg(300)->Arg(1400);
BENCHMARK(solve_openblas)->Arg(81)->Arg(300)->Arg(1400);

}  // namespace

int main(int argc, char** argv) {
  openblas_set_num_threads(1);
  benchmark::AddCustomContext("blas_core", openblas_get_corename());
  benchmark::AddCustomContext("kernels", kernel_target());
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
