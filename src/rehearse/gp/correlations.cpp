#include "rehearse/gp/correlations.hpp"

#include "rehearse/core/vector_math.hpp"

namespace rehearse::gp {

Matrix correlations(const Matrix& A, const Matrix& B) {
  Matrix C = Matrix::Zero(A.rows(), B.rows());
  for (Index j = 0; j < B.rows(); ++j)
    for (Index d = 0; d < A.cols(); ++d) C.col(j).array() -= (A.col(d).array() - B(j, d)).square() / 2;
  vector_exp(C.data(), C.data(), C.size());
  return C;
}

Matrix covariance(const Matrix& A, const Matrix& B, const Hyperparameters& kernel) {
  const auto times = [](const Matrix& X, const Vector& factors) { return Matrix(X * factors.asDiagonal()); };
  const Vector inverse_lengths = kernel.lengths().cwiseInverse();
  Matrix K = kernel.signal_variance() * correlations(times(A, inverse_lengths), times(B, inverse_lengths));
  if (!kernel.has_trend()) return K;
  const Vector deviations = kernel.log_trend.array().exp();
  const Vector slopes = deviations.tail(A.cols());
  const Matrix products = (times(A, slopes) * times(B, slopes).transpose()).array() + deviations(0) * deviations(0);
  return K + products.cwiseAbs2();
}

}  // namespace rehearse::gp
