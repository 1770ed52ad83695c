#include "rehearse/gp/moment_term.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/vector_math.hpp"

namespace rehearse::gp {
namespace {

MomentTerm mean_term(const Posterior& posterior, Index e) {
  const Inputs& inputs = posterior.inputs();
  Matrix centres = inputs.unit() * inputs.half_range().asDiagonal();
  centres.rowwise() += inputs.center().transpose();
  return {.output = e,
          .centres = std::move(centres),
          .log_lengths = posterior.hyperparameters()[static_cast<std::size_t>(e)].log_lengths,
          .weights = posterior.weights(e)};
}

/// σ_f² c(a, b) of the rows of A and B divided by the length scales.
Matrix covariance(const Matrix& A, const Matrix& B, double signal_variance) {
  Matrix K(A.rows(), B.rows());
  for (Index j = 0; j < B.rows(); ++j) K.col(j) = -0.5 * (A.rowwise() - B.row(j)).rowwise().squaredNorm();
  vector_exp(K.data(), K.data(), K.size());
  return signal_variance * K;
}

Eigen::LLT<Matrix> factorise(const Matrix& K, const char* what, Index e) {
  Eigen::LLT<Matrix> llt(K);
  if (llt.info() != Eigen::Success || !llt.matrixLLT().allFinite())
    throw InvalidInput(fmt::format("fitc: the {} of output {} is not positive definite", what, e));
  return llt;
}

/// With Q = K_nm K_mm⁻¹ K_mn and Λ = diag(K_nn − Q) + σ_n² I, the posterior of the values at the inducing inputs goes
/// with B = K_mm + K_mn Λ⁻¹ K_nm: mean k_mᵀ B⁻¹ K_mn Λ⁻¹ y, variance σ_f² − k_mᵀ (K_mm⁻¹ − B⁻¹) k_m (Snelson 2006,
/// eq. 8). With K_mm = L Lᵀ and V = L⁻¹ K_mn Λ^(−½), B = L (I + V Vᵀ) Lᵀ.
MomentTerm fitc_term(const Matrix& X, const Vector& y, const Matrix& Z, const Hyperparameters& theta, double ridge,
                     Index e) {
  const Vector inverse_lengths = (-theta.log_lengths).array().exp();
  const Matrix points = Z * inverse_lengths.asDiagonal(), inputs = X * inverse_lengths.asDiagonal();
  const double signal = theta.signal_variance();
  Matrix prior = covariance(points, points, signal);
  prior.diagonal().array() += ridge;
  const auto L = factorise(prior, "covariance of the inducing inputs", e);
  Matrix V = L.matrixL().solve(covariance(points, inputs, signal));
  const Vector rest =
      (signal + theta.noise_variance() - V.colwise().squaredNorm().transpose().array()).max(theta.noise_variance());
  V = V * rest.cwiseSqrt().cwiseInverse().asDiagonal();
  Matrix inner = Matrix::Identity(Z.rows(), Z.rows());
  inner.selfadjointView<Eigen::Lower>().rankUpdate(V);
  const auto A = factorise(inner, "posterior", e);
  const Vector target = V * y.cwiseQuotient(rest.cwiseSqrt());
  const Matrix inverse_factor = L.matrixL().solve(Matrix::Identity(Z.rows(), Z.rows()));
  const Matrix inverse_inner = A.matrixL().solve(inverse_factor);
  return {.output = e,
          .centres = Z,
          .log_lengths = theta.log_lengths,
          .weights = signal * (inverse_factor.transpose() * A.solve(target)),
          .variance = signal,
          .reduction = signal * signal *
                       (inverse_factor.transpose() * inverse_factor - inverse_inner.transpose() * inverse_inner)};
}

}  // namespace

std::vector<MomentTerm> exact_terms(const Posterior& posterior) {
  std::vector<MomentTerm> terms;
  for (Index e = 0; e < posterior.outputs(); ++e) {
    MomentTerm term = mean_term(posterior, e);
    const double signal = posterior.hyperparameters()[static_cast<std::size_t>(e)].signal_variance();
    const Matrix inverse_factor = posterior.inverse_factor(e);
    term.variance = signal;
    term.reduction = signal * (inverse_factor.transpose() * inverse_factor);
    terms.push_back(std::move(term));
  }
  return terms;
}

std::vector<MomentTerm> mean_terms(const Posterior& posterior, double jitter) {
  std::vector<MomentTerm> terms;
  for (Index e = 0; e < posterior.outputs(); ++e) {
    terms.push_back(mean_term(posterior, e));
    terms.back().variance = jitter;
  }
  return terms;
}

std::vector<MomentTerm> fitc_terms(const ConstMatrixView& X, const ConstMatrixView& Y, const ConstMatrixView& Z,
                                   const std::vector<Hyperparameters>& hyperparameters, double ridge) {
  Violations violations;
  violations.require(
      Z.rows() >= 1 && Z.cols() == X.cols(),
      fmt::format("fitc: the inducing inputs are {} × {}, must be m × {} with m ≥ 1", Z.rows(), Z.cols(), X.cols()));
  violations.require(Y.rows() == X.rows() && Y.rows() >= 1,
                     fmt::format("fitc: {} targets for {} inputs, must be as many and ≥ 1", Y.rows(), X.rows()));
  violations.require(static_cast<Index>(hyperparameters.size()) == Y.cols(),
                     fmt::format("fitc: {} sets of hyperparameters for {} outputs", hyperparameters.size(), Y.cols()));
  violations.require(ridge >= 0, fmt::format("fitc.ridge = {}, must be ≥ 0", ridge));
  for (std::size_t e = 0; e < hyperparameters.size(); ++e)
    for (auto& line : gp::violations(hyperparameters[e], X.cols(), fmt::format("hyperparameters[{}]", e)))
      violations.add(std::move(line));
  violations.throw_if_any();
  std::vector<MomentTerm> terms;
  for (Index e = 0; e < Y.cols(); ++e)
    terms.push_back(fitc_term(X, Y.col(e), Z, hyperparameters[static_cast<std::size_t>(e)], ridge, e));
  return terms;
}

}  // namespace rehearse::gp
