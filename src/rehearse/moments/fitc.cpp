#include "rehearse/moments/fitc.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/linear_algebra.hpp"
#include "rehearse/gp/correlations.hpp"
#include "rehearse/gp/evidence.hpp"

namespace rehearse::moments {
namespace {

/// L⁻¹ B and L⁻ᵀ B.
Matrix solve(const Matrix& L, Matrix B) {
  solve_lower(L, B);
  return B;
}
Matrix solve_transposed(const Matrix& L, Matrix B) {
  solve_lower_transposed(L, B);
  return B;
}

/// The lower Cholesky factor; false if A is not positive definite.
bool factorise(Matrix& A) {
  const bool found = cholesky(A);
  A.triangularView<Eigen::StrictlyUpper>().setZero();
  return found && A.allFinite();
}

/// With Q = K_nm K_mm⁻¹ K_mn, the covariance of y is taken to be Q + Λ, Λ = diag(K_nn − Q) + σ_n² I (Snelson 2006, eq.
/// 9). K_mm = L Lᵀ, V = L⁻¹ K_mn, so that Q = Vᵀ V; B = I + V Λ⁻¹ Vᵀ = F Fᵀ.
struct Fitc {
  Fitc(const Matrix& X, const Matrix& Z, const gp::Hyperparameters& theta, double ridge)
      : inverse_lengths((-theta.log_lengths).array().exp()),
        points(Z * inverse_lengths.asDiagonal()),
        inputs(X * inverse_lengths.asDiagonal()),
        Kmm(theta.signal_variance() * gp::correlations(points, points)),
        Kmn(theta.signal_variance() * gp::correlations(points, inputs)),
        L(Kmm) {
    L.diagonal().array() += ridge * theta.signal_variance();
    if (!factorise(L)) return;
    V = solve(L, Kmn);
    const double noise = theta.noise_variance();
    rest = (theta.signal_variance() - V.colwise().squaredNorm().transpose().array()).max(0) + noise;
    F = product(Matrix(V * rest.cwiseInverse().asDiagonal()), V.transpose());
    F.diagonal().array() += 1;
    ok = factorise(F) && V.allFinite() && (rest.array() > 0).all() && rest.allFinite();
  }

  Vector inverse_lengths;
  Matrix points, inputs;  // divided by the length scales
  Matrix Kmm, Kmn, L, V, F;
  Vector rest;  // diag Λ
  bool ok = false;
};

/// Mean k_mᵀ L⁻ᵀ B⁻¹ V Λ⁻¹ y; variance σ_f² − k_mᵀ L⁻ᵀ (I − B⁻¹) L⁻¹ k_m.
MomentTerm fitc_term(const Fitc& fitc, const Vector& y, const Matrix& Z, const gp::Hyperparameters& theta, Index e) {
  const double signal = theta.signal_variance();
  const Matrix inverse_L = solve(fitc.L, Matrix::Identity(Z.rows(), Z.rows())), both = solve(fitc.F, inverse_L);
  const Matrix weights = product(both.transpose(), solve(fitc.F, fitc.V * y.cwiseQuotient(fitc.rest)));
  return {.output = e,
          .centres = Z,
          .log_lengths = theta.log_lengths,
          .weights = signal * weights,
          .variance = signal,
          .reduction = signal * signal * (product(inverse_L.transpose(), inverse_L) - product(both.transpose(), both))};
}

/// With G = ½ (α αᵀ − Σ⁻¹) the gradient by the covariance Σ of y, of which only what is off the diagonal depends on Z:
/// that by V is 2 V (G − diag G), by K_mn P = L⁻ᵀ of it, by K_mm −½ P (L⁻ᵀ V)ᵀ.
Matrix gradient_by_points(const Fitc& f, const Vector& alpha) {
  const Matrix whitened = solve(f.F, f.V * f.rest.cwiseInverse().asDiagonal());  // Σ⁻¹ = Λ⁻¹ − whitenedᵀ whitened
  const Vector by_diagonal = alpha.cwiseAbs2() - f.rest.cwiseInverse() + whitened.colwise().squaredNorm().transpose();
  const Matrix by_V =
      f.V * alpha * alpha.transpose() - solve_transposed(f.F, whitened) - f.V * by_diagonal.asDiagonal();
  const Matrix P = solve_transposed(f.L, by_V);
  const Matrix by_Kmm = product(P, solve_transposed(f.L, f.V).transpose());
  const Matrix mn = P.cwiseProduct(f.Kmn), mm = (by_Kmm + by_Kmm.transpose()).cwiseProduct(f.Kmm) / -2;
  const Vector sums = mn.rowwise().sum() + mm.rowwise().sum();
  return (product(mn, f.inputs) + product(mm, f.points) - sums.asDiagonal() * f.points) *
         f.inverse_lengths.asDiagonal();
}

void check(const ConstMatrixView& X, const ConstMatrixView& Y, const ConstMatrixView& Z,
           const std::vector<gp::Hyperparameters>& hyperparameters, double ridge) {
  Violations violations;
  violations.require(
      Z.rows() >= 1 && Z.cols() == X.cols(),
      fmt::format("fitc: the inducing inputs are {} × {}, must be m × {} with m ≥ 1", Z.rows(), Z.cols(), X.cols()));
  violations.require(Y.rows() == X.rows() && Y.rows() >= 1,
                     fmt::format("fitc: {} targets for {} inputs, must be as many and ≥ 1", Y.rows(), X.rows()));
  violations.require(static_cast<Index>(hyperparameters.size()) == Y.cols(),
                     fmt::format("fitc: {} sets of hyperparameters for {} outputs", hyperparameters.size(), Y.cols()));
  violations.require(ridge >= 0, fmt::format("fitc.ridge = {}, must be ≥ 0", ridge));
  for (const gp::Hyperparameters& each : hyperparameters)
    violations.require(!each.has_trend(), "fitc: no moments of a gp with a trend");
  for (std::size_t e = 0; e < hyperparameters.size(); ++e)
    for (auto& line : gp::violations(hyperparameters[e], X.cols(), fmt::format("hyperparameters[{}]", e)))
      violations.add(std::move(line));
  violations.throw_if_any();
}

}  // namespace

std::vector<MomentTerm> fitc_terms(const ConstMatrixView& X, const ConstMatrixView& Y, const ConstMatrixView& Z,
                                   const std::vector<gp::Hyperparameters>& hyperparameters, double ridge) {
  check(X, Y, Z, hyperparameters, ridge);
  std::vector<MomentTerm> terms;
  for (Index e = 0; e < Y.cols(); ++e) {
    const gp::Hyperparameters& theta = hyperparameters[static_cast<std::size_t>(e)];
    const Fitc fitc(X, Z, theta, ridge);
    if (!fitc.ok) throw InvalidInput(fmt::format("fitc: the covariances of output {} are not positive definite", e));
    terms.push_back(fitc_term(fitc, Y.col(e), Z, theta, e));
  }
  return terms;
}

double fitc_evidence(const ConstMatrixView& X, const ConstVectorView& y, const ConstMatrixView& Z,
                     const gp::Hyperparameters& hyperparameters, Matrix* gradient, double ridge) {
  check(X, y, Z, {hyperparameters}, ridge);
  if (gradient) gradient->setConstant(Z.rows(), Z.cols(), kNaN);
  const Fitc f(X, Z, hyperparameters, ridge);
  if (!f.ok) return kNaN;
  const Vector scaled = y.cwiseQuotient(f.rest);
  const Matrix whitened = solve(f.F, f.V * scaled);
  const double log_determinant = f.rest.array().log().sum() + 2 * f.F.diagonal().array().log().sum();
  const double quadratic = y.dot(scaled) - whitened.squaredNorm();
  const double value = -(log_determinant + quadratic + static_cast<double>(y.size()) * gp::kLogTwoPi) / 2;
  if (!std::isfinite(value)) return kNaN;
  if (gradient) {
    const Vector alpha = scaled - (f.V.transpose() * solve_transposed(f.F, whitened)).cwiseQuotient(f.rest);
    *gradient = gradient_by_points(f, alpha);
  }
  return value;
}

}  // namespace rehearse::moments
