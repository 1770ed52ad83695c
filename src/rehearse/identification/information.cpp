#include "rehearse/identification/information.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "rehearse/identification/coordinates.hpp"

namespace rehearse::identification {
namespace {

constexpr double kErrors = 2;  // times those of derivatives by differences: less is not resolved
constexpr double kWeak = 0.1;  // deviation, as a fraction of the boxes, of a direction that is followed

/// Directions of z (q × q), and the precision of each: that of the boxes, and of these factors what differences
/// resolve.
struct Directions {
  Matrix vectors;
  Vector precisions;
};
Directions directions_of(const Matrix& factor, const Matrix& errors) {
  const Index q = errors.cols();
  Matrix with_box(factor.rows() + q, q);
  with_box << factor, std::sqrt(kBoxPrecision) * Matrix::Identity(q, q);
  const Eigen::JacobiSVD<Matrix> svd(with_box, Eigen::ComputeThinV);
  const Matrix& V = svd.matrixV();
  const Vector unresolved = kErrors * kErrors * (V.transpose() * errors * V).diagonal();
  return {V, (svd.singularValues().cwiseAbs2() - unresolved).cwiseMax(kBoxPrecision)};
}

Vector inside_box(const Vector& way, const Vector& z) { return (z + way).cwiseMax(0).cwiseMin(1) - z; }

}  // namespace

Information information(const NearResiduals& residuals, const Matrix& misfit) {
  const Matrix J = residuals.whiten(residuals.derivatives), A = residuals.whiten(misfit);
  const Matrix unresolved = residuals.whiten(residuals.errors);
  const Vector y = residuals.whiten(residuals.y);
  if (!J.allFinite() || !A.allFinite() || !unresolved.allFinite() || !y.allFinite()) return {};
  if (A.cols() == 0) return {J, -J.transpose() * y, J, unresolved.transpose() * unresolved};
  // (I + A Aᵀ)^−½ = I − U (1 − (1 + S²)^−½) Uᵀ with A = U S Vᵀ.
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeThinU);
  const Matrix& U = svd.matrixU();
  const Vector shorter = 1 - (1 + svd.singularValues().array().square()).rsqrt();
  const auto narrowed = [&](const Matrix& X) { return Matrix(X - U * (shorter.asDiagonal() * (U.transpose() * X))); };
  const Matrix F = narrowed(J);
  return {F, -F.transpose() * narrowed(y), J, unresolved.transpose() * unresolved};
}

Matrix spread_over(const Matrix& J, double variance) {
  const Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeThinU);
  return std::sqrt(variance) * svd.matrixU().leftCols(variance > 0 ? svd.rank() : 0);
}

Matrix covariance_of(const Information& information, const Vector& z) {
  const Directions directions = directions_of(information.factor, information.errors);
  const Matrix root = directions.vectors * directions.precisions.cwiseSqrt().cwiseInverse().asDiagonal();
  const Matrix covariance = root * root.transpose();
  const Vector left = inside_box(covariance * information.gradient, z);
  return covariance + left * left.transpose();
}

Matrix weak_directions(const Information& information) {
  const Directions directions = directions_of(information.data, information.errors);
  std::vector<Index> weak;
  for (Index k = 0; k < directions.precisions.size(); ++k)
    if (directions.precisions(k) < kBoxPrecision + 1 / (kWeak * kWeak)) weak.push_back(k);
  return directions.vectors(Eigen::all, weak);
}

Vector way_to_explain(const Matrix& J, const Vector& explained, const Vector& deviations, const Vector& z) {
  const Matrix weighted = deviations.cwiseInverse().asDiagonal() * J;
  Matrix precision = weighted.transpose() * weighted;
  precision.diagonal().array() += kBoxPrecision;
  const Vector way = -precision.llt().solve(weighted.transpose() * explained.cwiseQuotient(deviations));
  return way.allFinite() ? inside_box(way, z) : Vector(Vector::Zero(z.size()));
}

}  // namespace rehearse::identification
