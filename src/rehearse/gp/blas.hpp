#pragma once
// The routines of BLAS and LAPACK used here, of OpenBLAS's pthread flavour on one thread: we bring our own threads.
// Column-major, arguments by address, as Fortran has them.

#include <string>

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrtri_(const char* uplo, const char* diag, const int* n, double* a, const int* lda, int* info);
void dtrmm_(const char* side, const char* uplo, const char* transa, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
void dtrsv_(const char* uplo, const char* trans, const char* diag, const int* n, const double* a, const int* lda,
            double* x, const int* incx);
}

namespace rehearse::gp {

/// Sets OpenBLAS to one thread, the first time; call before any BLAS routine. Any thread.
void use_one_blas_thread();

/// The kernel that OpenBLAS chose for this processor ("SkylakeX"), for the log.
std::string blas_core();

}  // namespace rehearse::gp
