#include "rehearse/moments/moment_narrow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rehearse::moments {
namespace {

/// The square root of what rounding adds to a sum over all pairs; that of the sum's size without it.
double rounding_root(const MomentTerm& t) {
  return std::sqrt(std::numeric_limits<double>::epsilon() * static_cast<double>(t.size()) *
                   std::max(t.reduction.norm(), t.weights.squaredNorm()));
}
double size_root(const MomentTerm& t) {
  return t.reduction.size() > 0 ? std::sqrt(t.variance) : t.weights.cwiseAbs().maxCoeff();
}

/// h (1, z): n × (1 + D), and its sums with the weights.
struct Expansion {
  Expansion(const NarrowSide& side, double log_scale) {
    const Index n = side.term.size(), D = side.points.cols();
    const auto Z = side.points.topRows(n);
    const Vector exponent = (Z * side.form).cwiseProduct(Z).rowwise().sum();
    H.resize(n, 1 + D);
    H.col(0) = (exponent.array() + log_scale / 2).exp();
    H.rightCols(D) = H.col(0).asDiagonal() * Z;
    sums = H.transpose() * side.term.weights;
    const Vector change = (Z * side.form_change).cwiseProduct(Z).rowwise().sum();
    const auto excess = (change.array() + side.scale_change).unaryExpr([](double x) { return std::expm1(x); });
    mean = side.term.weights.dot(side.correlations);
    mean_change = (side.term.weights.array() * side.correlations.array() * excess).sum();
  }
  Matrix H;
  Vector sums;               // 1 + D
  double mean, mean_change;  // E[f]; Σ w h less that, without the cancellation
};

/// The points' part of first and second: G the sum of a row.
void point_part(const ConstMatrixView& Z, const Vector& G, PointSums& out) {
  const Index D = Z.cols();
  Eigen::Map<Vector>(out.first, D) = Z.transpose() * G;
  Eigen::Map<Matrix>(out.second, D, D) = Z.transpose() * G.asDiagonal() * Z;
}

/// Σ_j W_ij h_j (1 + t_ij) h_i from P = W H.
Vector row_sums(const Matrix& P, const Matrix& H, const Matrix& C) {
  const Index D = C.rows();
  return P.col(0).cwiseProduct(H.col(0)) +
         (P.rightCols(D) * C.transpose()).cwiseProduct(H.rightCols(D)).rowwise().sum();
}

}  // namespace

double narrow_limit(const MomentTerm& a, const MomentTerm& b) {
  const double size = size_root(a) * size_root(b);
  return size > 0 ? std::sqrt(rounding_root(a) * rounding_root(b) / size) : 0;
}

bool crosses_within(const Matrix& points_a, const ConstMatrixView& forward_a, const Matrix& points_b,
                    const ConstMatrixView& forward_b, double limit) {
  const auto form = [](const Matrix& Z, Index i, const ConstMatrixView& forward) {
    double sum = 0;
    for (Index d = 0; d < Z.cols(); ++d)
      for (Index k = 0; k < Z.cols(); ++k) sum += forward(k, d) * Z(i, k) * Z(i, d);
    return sum;
  };
  double a = 0, b = 0;
  for (Index i = 0; i < std::max(points_a.rows(), points_b.rows()); ++i) {
    if (i < points_a.rows()) a = std::max(a, form(points_a, i, forward_a));
    if (i < points_b.rows()) b = std::max(b, form(points_b, i, forward_b));
    if (!(2 * std::sqrt(a * b) <= limit)) return false;
  }
  return true;
}

double narrow_sums(const NarrowSide& a, const NarrowSide& b, const Matrix& C, double log_scale, bool own,
                   PairSums& sums) {
  const Index D = C.rows();
  const Expansion ea(a, log_scale), eb(b, log_scale);
  const auto Za = a.points.topRows(a.term.size()), Zb = b.points.topRows(b.term.size());
  Matrix P = a.term.weights * eb.sums.transpose();  // Σ_j W_ij h_j (1, z_j)
  double covariance =
      ea.mean_change * eb.mean + eb.mean_change * (ea.mean + ea.mean_change) + ea.sums.tail(D).dot(C * eb.sums.tail(D));
  if (own) {
    const Matrix whitened = a.term.factor * ea.H;
    const double reduction =
        whitened.col(0).squaredNorm() + (whitened.rightCols(D) * C).cwiseProduct(whitened.rightCols(D)).sum();
    covariance += std::max(0.0, a.term.variance - reduction) - a.term.variance;
    P -= a.term.factor.transpose() * whitened;
  }
  point_part(Za, row_sums(P, ea.H, C), sums.a);
  if (own) {
    point_part(Za, row_sums(P, ea.H, C), sums.b);
  } else {
    point_part(Zb, row_sums(b.term.weights * ea.sums.transpose(), eb.H, C.transpose()), sums.b);
  }
  Eigen::Map<Matrix>(sums.cross, D, D) = ea.H.rightCols(D).transpose() * P.rightCols(D);
  return covariance;
}

}  // namespace rehearse::moments
