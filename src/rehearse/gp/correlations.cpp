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

Matrix covariance(const Matrix& X, const Hyperparameters& kernel) {
  const Matrix scaled = X * kernel.lengths().cwiseInverse().asDiagonal();
  Matrix K = kernel.signal_variance() * correlations(scaled, scaled);
  if (!kernel.has_trend()) return K;
  const Vector deviations = kernel.log_trend.array().exp();
  const Matrix Z = X * deviations.tail(X.cols()).asDiagonal();
  const Matrix products = (Z * Z.transpose()).array() + deviations(0) * deviations(0);
  return K + products.cwiseAbs2();
}

}  // namespace rehearse::gp
