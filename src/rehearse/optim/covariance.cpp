#include "rehearse/optim/covariance.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/core/linear_algebra.hpp"

namespace rehearse::optim {

Covariance::Covariance(Index n, Root root)
    : root_(root), C_(Matrix::Identity(n, n)), A_(C_), projected_(n), next_(n, n) {
  if (root == Root::cholesky) return;
  B_ = C_;
  eigenvalues_ = Vector::Ones(n);
}

void Covariance::update(double decay, const ConstMatrixView& P, const ConstMatrixView& N) {
  both_.resize(size(), P.cols() + N.cols()), signed_.resizeLike(both_);
  both_.leftCols(P.cols()) = signed_.leftCols(P.cols()) = P;
  both_.rightCols(N.cols()) = N;
  signed_.rightCols(N.cols()) = -N;
  add_product(C_, Sign::plus, both_, signed_.transpose(), Part::lower, decay);
}

void Covariance::scale(Index i, double factor) {
  C_.row(i).head(i) *= factor;
  C_.col(i).tail(size() - i - 1) *= factor;
  C_(i, i) *= factor * factor;
}

bool Covariance::decompose() { return root_ == Root::eigen ? decompose_eigen() : decompose_cholesky(); }

bool Covariance::decompose_eigen() {
  solver_.compute(C_);  // of the lower triangle
  if (solver_.info() != Eigen::Success) return false;
  const Vector& values = solver_.eigenvalues();
  if (!(values(0) > 0) || !std::isfinite(values(size() - 1))) return false;
  B_ = solver_.eigenvectors();
  eigenvalues_ = values;
  A_.noalias() = B_ * eigenvalues_.cwiseSqrt().asDiagonal();
  return true;
}

bool Covariance::decompose_cholesky() {
  next_.triangularView<Eigen::Lower>() = C_;
  next_.triangularView<Eigen::StrictlyUpper>().setZero();
  if (!cholesky(next_) || !next_.diagonal().allFinite()) return false;
  A_.swap(next_);
  return true;
}

void Covariance::colour(const ConstMatrixView& Z, MatrixView Y) const {
  Y.setZero();
  if (root_ == Root::eigen) return add_product(Y, Sign::plus, A_, Z.transpose());
  constexpr Index kBlock = 120;  // rows that are multiplied without the zeros to the right of them
  for (Index i = 0; i < size(); i += kBlock) {
    const Index rows = std::min(kBlock, size() - i), inner = i + rows;
    add_product(Y.middleRows(i, rows), Sign::plus, A_.block(i, 0, rows, inner), Z.leftCols(inner).transpose());
  }
}

void Covariance::whiten(const ConstVectorView& y, VectorView z) const {
  if (root_ == Root::eigen) {
    projected_.noalias() = B_.transpose() * y;
    projected_.array() /= eigenvalues_.array().sqrt();
    z.noalias() = B_ * projected_;
  } else {
    z = y;
    A_.triangularView<Eigen::Lower>().solveInPlace(z);
  }
}

double Covariance::length(const ConstVectorView& y) const {
  if (root_ == Root::cholesky) {
    whiten(y, projected_);
    return projected_.norm();
  }
  projected_.noalias() = B_.transpose() * y;
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
