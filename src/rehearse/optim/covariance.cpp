#include "rehearse/optim/covariance.hpp"

#include <cmath>

#include "rehearse/optim/blas.hpp"

namespace rehearse::optim {
namespace {

int as_int(Index n) { return static_cast<int>(n); }

/// C ← beta·C + alpha A Aᵀ on the lower triangle.
void add_products(double beta, double alpha, const ConstMatrixView& A, Matrix& C) {
  const int n = as_int(C.rows()), k = as_int(A.cols()), stride = as_int(A.outerStride());
  dsyrk_("L", "N", &n, &k, &alpha, A.data(), &stride, &beta, C.data(), &n);
}

/// y = A x or Aᵀ x.
void multiply(const char* transposed, const Matrix& A, const double* x, double* y) {
  const int n = as_int(A.rows()), one = 1;
  const double unit = 1, zero = 0;
  dgemv_(transposed, &n, &n, &unit, A.data(), &n, x, &one, &zero, y, &one);
}

}  // namespace

Covariance::Covariance(Index n, Root root)
    : root_(root), C_(Matrix::Identity(n, n)), A_(C_), projected_(n), next_(n, n) {
  use_one_blas_thread();
  if (root == Root::cholesky) return;
  B_ = C_;
  eigenvalues_ = Vector::Ones(n);
  values_.resize(n);
  work_.resize(static_cast<std::size_t>(1 + 6 * n + 2 * n * n));
  iwork_.resize(static_cast<std::size_t>(3 + 5 * n));
}

void Covariance::update(double decay, const ConstMatrixView& P, const ConstMatrixView& N) {
  add_products(decay, 1, P, C_);
  if (N.cols() > 0) add_products(1, -1, N, C_);
}

void Covariance::scale(Index i, double factor) {
  C_.row(i).head(i) *= factor;
  C_.col(i).tail(size() - i - 1) *= factor;
  C_(i, i) *= factor * factor;
}

bool Covariance::decompose() { return root_ == Root::eigen ? decompose_eigen() : decompose_cholesky(); }

bool Covariance::decompose_eigen() {
  const int n = as_int(size()), lwork = static_cast<int>(work_.size()), liwork = static_cast<int>(iwork_.size());
  int info = 0;
  next_ = C_;
  dsyevd_("V", "L", &n, next_.data(), &n, values_.data(), work_.data(), &lwork, iwork_.data(), &liwork, &info);
  if (info != 0 || !(values_(0) > 0) || !std::isfinite(values_(size() - 1))) return false;
  B_.swap(next_);
  eigenvalues_.swap(values_);
  A_.noalias() = B_ * eigenvalues_.cwiseSqrt().asDiagonal();
  return true;
}

bool Covariance::decompose_cholesky() {
  const int n = as_int(size());
  int info = 0;
  next_.triangularView<Eigen::Lower>() = C_;
  next_.triangularView<Eigen::StrictlyUpper>().setZero();
  dpotrf_("L", &n, next_.data(), &n, &info);
  if (info != 0 || !next_.diagonal().allFinite()) return false;
  A_.swap(next_);
  return true;
}

void Covariance::colour(const ConstMatrixView& Z, MatrixView Y) const {
  const int n = as_int(size()), k = as_int(Z.rows());
  const int stride_z = as_int(Z.outerStride()), stride_y = as_int(Y.outerStride());
  const double unit = 1, zero = 0;
  if (root_ == Root::eigen) {
    dgemm_("N", "T", &n, &k, &n, &unit, A_.data(), &n, Z.data(), &stride_z, &zero, Y.data(), &stride_y);
  } else {
    Y = Z.transpose();
    dtrmm_("L", "L", "N", "N", &n, &k, &unit, A_.data(), &n, Y.data(), &stride_y);
  }
}

void Covariance::whiten(const ConstVectorView& y, VectorView z) const {
  if (root_ == Root::eigen) {
    multiply("T", B_, y.data(), projected_.data());
    projected_.array() /= eigenvalues_.array().sqrt();
    multiply("N", B_, projected_.data(), z.data());
  } else {
    const int n = as_int(size()), one = 1;
    z = y;
    dtrsv_("L", "N", "N", &n, A_.data(), &n, z.data(), &one);
  }
}

double Covariance::length(const ConstVectorView& y) const {
  if (root_ == Root::cholesky) {
    whiten(y, projected_);
    return projected_.norm();
  }
  multiply("T", B_, y.data(), projected_.data());
  return std::sqrt((projected_.array().square() / eigenvalues_.array()).sum());
}

double Covariance::condition() const {
  if (root_ == Root::eigen) return eigenvalues_(size() - 1) / eigenvalues_(0);
  const double ratio = A_.diagonal().maxCoeff() / A_.diagonal().minCoeff();
  return ratio * ratio;
}

double Covariance::largest_eigenvalue() const {
  return root_ == Root::eigen ? eigenvalues_(size() - 1) : C_.diagonal().maxCoeff();
}

}  // namespace rehearse::optim
