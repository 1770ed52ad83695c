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

}  // namespace rehearse::gp
