#include "rehearse/identification/score.hpp"

#include <cmath>

namespace rehearse::identification {
namespace {

// Sum and harmonic mean n / Σ 1/p_i are both a log Σ exp, of log p_i or of −log p_i.
double sign(Score score) { return score == Score::sum ? 1 : -1; }

}  // namespace

double score_of(const Vector& log_likelihoods, Score score) {
  if (log_likelihoods.size() == 0) return 0;
  if (!log_likelihoods.allFinite()) return -kInf;
  if (score == Score::product) return log_likelihoods.sum();
  const double largest = (sign(score) * log_likelihoods).maxCoeff();
  const double log_sum = largest + std::log((sign(score) * log_likelihoods.array() - largest).exp().sum());
  return score == Score::sum ? log_sum : std::log(static_cast<double>(log_likelihoods.size())) - log_sum;
}

Vector score_gradient(const Vector& log_likelihoods, Score score) {
  if (score == Score::product || log_likelihoods.size() == 0) return Vector::Ones(log_likelihoods.size());
  const double largest = (sign(score) * log_likelihoods).maxCoeff();
  const Vector terms = (sign(score) * log_likelihoods.array() - largest).exp();
  return terms / terms.sum();
}

}  // namespace rehearse::identification
