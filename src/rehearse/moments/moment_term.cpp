#include "rehearse/moments/moment_term.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/correlations.hpp"
#include "rehearse/gp/sizes.hpp"

namespace rehearse::moments {
namespace {

MomentTerm mean_term(const gp::Posterior& posterior, Index e) {
  if (posterior.hyperparameters()[static_cast<std::size_t>(e)].has_trend())
    throw InvalidInput("no moments of a gp with a trend");
  return {.output = e,
          .centres = posterior.inputs().values(),
          .log_lengths = posterior.hyperparameters()[static_cast<std::size_t>(e)].log_lengths,
          .weights = posterior.weights(e)};
}

}  // namespace

std::vector<MomentTerm> exact_terms(const gp::Posterior& posterior) {
  std::vector<MomentTerm> terms;
  for (Index e = 0; e < posterior.outputs(); ++e) {
    MomentTerm term = mean_term(posterior, e);
    const double signal = posterior.hyperparameters()[static_cast<std::size_t>(e)].signal_variance();
    const Matrix inverse_factor = posterior.inverse_factor(e);
    term.variance = signal;
    term.reduction = signal * (inverse_factor.transpose() * inverse_factor);
    term.factor = std::sqrt(signal) * inverse_factor;
    terms.push_back(std::move(term));
  }
  return terms;
}

std::vector<MomentTerm> mean_terms(const gp::Posterior& posterior, double jitter) {
  std::vector<MomentTerm> terms;
  for (Index e = 0; e < posterior.outputs(); ++e) {
    terms.push_back(mean_term(posterior, e));
    terms.back().variance = jitter;
  }
  return terms;
}

std::vector<MomentTerm> mean_terms(std::vector<MomentTerm> terms, double jitter) {
  for (MomentTerm& term : terms) {
    term.variance = jitter;
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

}  // namespace rehearse::moments
