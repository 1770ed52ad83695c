#include "rehearse/dynamics/errors_in_variables.hpp"

namespace rehearse::dynamics {

Matrix ErrorsInVariables::covariance_of_errors(const Vector& R) const {
  return Matrix(B * repeated(R, B.cols() / R.size()).asDiagonal() * B.transpose());
}

Matrix ErrorsInVariables::covariance(const Vector& R, const Vector& W) const {
  const Index rows = B.rows() / W.size();
  Matrix C = covariance_of_errors(R);
  C.diagonal() += repeated(W, rows);
  for (std::size_t e = 0; e < K.size(); ++e) {
    const Index first = static_cast<Index>(e) * rows;
    C.block(first, first, rows, rows) += K[e];
  }
  return C;
}

Eigen::SparseMatrix<double> errors_of(const Block& block, const std::vector<Matrix>& before,
                                      const std::vector<Matrix>& after) {
  const auto dx = static_cast<Index>(before.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (Index d = 0; d < dx; ++d)
    for (Index e = 0; e < dx; ++e)
      for (Index i = 0; i < block.rows; ++i) {
        const auto of = static_cast<std::size_t>(d);
        const Index row = e * block.rows + i;
        const Index column = d * block.measurements + block.before[static_cast<std::size_t>(i)];
        entries.emplace_back(row, column, before[of](block.first + i, e));
        entries.emplace_back(row, column + 1, after[of](block.first + i, e));
      }
  Eigen::SparseMatrix<double> B(dx * block.rows, dx * block.measurements);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

Vector repeated(const Vector& values, Index n) { return values.transpose().replicate(n, 1).reshaped(); }

}  // namespace rehearse::dynamics
