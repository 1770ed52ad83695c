#include "rehearse/moments/moment_term.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/correlations.hpp"
#include "rehearse/gp/sizes.hpp"
#include "rehearse/moments/moment_kernel.hpp"

namespace rehearse::moments {

std::vector<MomentTerm> exact_terms(const gp::Posterior& posterior) {
  std::vector<MomentTerm> terms;
  for (Index e = 0; e < posterior.outputs(); ++e) {
    const gp::Hyperparameters& kernel = posterior.hyperparameters()[static_cast<std::size_t>(e)];
    if (kernel.has_trend()) throw InvalidInput("no moments of a gp with a trend");
    const double signal = kernel.signal_variance();
    const Matrix inverse_factor = posterior.inverse_factor(e);
    terms.push_back({.output = e,
                     .centres = posterior.inputs().values(),
                     .log_lengths = kernel.log_lengths,
                     .weights = posterior.weights(e),
                     .variance = signal,
                     .reduction = signal * (inverse_factor.transpose() * inverse_factor),
                     .factor = std::sqrt(signal) * inverse_factor});
  }
  return terms;
}

std::vector<MomentTerm> mean_terms(std::vector<MomentTerm> terms) {
  for (MomentTerm& term : terms) {
    term.variance = 0;
    term.reduction.resize(0, 0);
    term.factor.resize(0, 0);
  }
  return terms;
}

Matrix evaluate_means(const std::vector<MomentTerm>& terms, Index outputs, const ConstMatrixView& X) {
  Matrix means = Matrix::Zero(X.rows(), outputs);
  for (const MomentTerm& term : terms) {
    gp::require_size("inputs of moments", X.cols(), term.inputs());
    if (term.output < 0 || term.output >= outputs)
      throw InvalidInput(fmt::format("gp output = {}, must be below {}", term.output, outputs));
    const Vector inverse_lengths = (-term.log_lengths).array().exp();
    const Matrix C = gp::correlations(X * inverse_lengths.asDiagonal(), term.centres * inverse_lengths.asDiagonal());
    for (Index i = 0; i < term.size(); ++i) means.col(term.output) += term.weights(i) * C.col(i);
  }
  return means;
}

void require_terms(const std::vector<MomentTerm>& terms, Index outputs, bool parameters) {
  Violations violations;
  violations.require(!terms.empty(), "moments: no terms");
  const Index D = terms.empty() ? 0 : terms.front().inputs();
  violations.require(D >= 1 && D <= kMostMomentInputs,
                     fmt::format("moments: {} inputs, must be in 1..{}", D, kMostMomentInputs));
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const MomentTerm& t = terms[k];
    const Index n = t.size();
    const bool sizes = n >= 1 && t.inputs() == D && t.log_lengths.size() == D && t.weights.size() == n &&
                       (t.reduction.size() == 0 || (t.reduction.rows() == n && t.reduction.cols() == n));
    violations.require(t.factor.size() == 0 || (t.factor.rows() == n && t.factor.cols() == n),
                       fmt::format("moments: the factor of term {} is {} × {}, must be {} × {}", k, t.factor.rows(),
                                   t.factor.cols(), n, n));
    violations.require(sizes, fmt::format("moments: sizes of term {} do not agree", k));
    violations.require(t.output >= 0 && t.output < outputs,
                       fmt::format("moments: output {} of term {}, must be below {}", t.output, k, outputs));
    violations.require(t.centres.allFinite() && t.log_lengths.allFinite() && t.weights.allFinite() &&
                           t.reduction.allFinite() && std::isfinite(t.variance),
                       fmt::format("moments: term {} is not finite", k));
    violations.require(!parameters || t.reduction.size() == 0,
                       fmt::format("moments: term {} has an uncertainty, and so no adjoint of its own", k));
  }
  violations.throw_if_any();
}

}  // namespace rehearse::moments
