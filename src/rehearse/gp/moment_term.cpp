#include "rehearse/gp/moment_term.hpp"

#include "rehearse/core/errors.hpp"

namespace rehearse::gp {
namespace {

MomentTerm mean_term(const Posterior& posterior, Index e) {
  if (posterior.hyperparameters()[static_cast<std::size_t>(e)].has_trend())
    throw InvalidInput("no moments of a gp with a trend");
  const Inputs& inputs = posterior.inputs();
  Matrix centres = inputs.unit() * inputs.half_range().asDiagonal();
  centres.rowwise() += inputs.center().transpose();
  return {.output = e,
          .centres = std::move(centres),
          .log_lengths = posterior.hyperparameters()[static_cast<std::size_t>(e)].log_lengths,
          .weights = posterior.weights(e)};
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

}  // namespace rehearse::gp
