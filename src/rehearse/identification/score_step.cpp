#include "rehearse/identification/score_step.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace rehearse::identification {
namespace {

constexpr int kMostScoreSteps = 60, kMostHalvings = 20;
constexpr double kGain = 1e-6;  // nats: a smaller one ends the search

struct Ascent {
  Vector gradient;
  Matrix curvature;  // of minus the function, made positive
};

/// Gradient and curvature of the score at d. The sum's log Σ exp is convex in the log likelihoods, that of the harmonic
/// mean concave: its curvature counts, that of the sum is left out, which makes the step shorter and safe.
Ascent ascent_at(const Quadratics& quadratics, Score score, const Vector& d) {
  const Index q = d.size();
  const Vector weights = score_gradient(quadratics.at(d), score);
  Ascent ascent{Vector::Zero(q), Matrix::Zero(q, q)};
  for (Index e = 0; e < weights.size(); ++e) {
    const Matrix& A = quadratics.curvatures[static_cast<std::size_t>(e)];
    const Vector slope = quadratics.gradients.col(e) - A * d;
    ascent.gradient += weights(e) * slope;
    ascent.curvature += weights(e) * A;
    if (score == Score::harmonic) ascent.curvature += weights(e) * slope * slope.transpose();
  }
  if (score == Score::harmonic) ascent.curvature -= ascent.gradient * ascent.gradient.transpose();
  return ascent;
}

/// Newton's step; coordinates that it would move out of the box from its border stay.
Vector newton_step(const Ascent& ascent, const Vector& d, const Vector& low, const Vector& high) {
  std::vector<Index> free;
  for (Index i = 0; i < d.size(); ++i) free.push_back(i);
  Vector step = Vector::Zero(d.size());
  while (!free.empty()) {
    step.setZero();
    const Matrix curvature = ascent.curvature(free, free);
    const Vector gradient = ascent.gradient(free), solved = curvature.ldlt().solve(gradient);
    step(free) = solved;
    const auto leaves = [&](Index i) {
      return (d(i) <= low(i) && step(i) < 0) || (d(i) >= high(i) && step(i) > 0) || !std::isfinite(step(i));
    };
    const auto kept = std::remove_if(free.begin(), free.end(), leaves);
    if (kept == free.end()) return step;
    free.erase(kept, free.end());
  }
  return Vector::Zero(d.size());
}

}  // namespace

Vector Quadratics::at(const Vector& d) const {
  Vector result = values + gradients.transpose() * d;
  for (Index e = 0; e < values.size(); ++e) result(e) -= 0.5 * d.dot(curvatures[static_cast<std::size_t>(e)] * d);
  return result;
}

Vector best_step(const Quadratics& quadratics, Score score, const Vector& low, const Vector& high, double damping) {
  Vector d = Vector::Zero(low.size());
  const Vector diagonal = ascent_at(quadratics, score, d).curvature.diagonal();
  const Vector penalty = damping * diagonal.cwiseMax(1e-12 * diagonal.maxCoeff()).cwiseMax(1e-300);
  const auto objective = [&](const Vector& x) {
    return score_of(quadratics.at(x), score) - 0.5 * x.dot(penalty.cwiseProduct(x));
  };
  double value = objective(d);
  for (int i = 0; i < kMostScoreSteps; ++i) {
    Ascent ascent = ascent_at(quadratics, score, d);
    ascent.gradient -= penalty.cwiseProduct(d);
    ascent.curvature.diagonal() += penalty;
    const Vector step = newton_step(ascent, d, low, high);
    double gain = 0, length = 1;
    for (int j = 0; j < kMostHalvings && !(gain > 0); ++j, length /= 2) {
      const Vector next = (d + length * step).cwiseMax(low).cwiseMin(high);
      gain = objective(next) - value;
      if (gain > 0) d = next;
    }
    if (!(gain > kGain)) break;
    value += gain;
  }
  return d;
}

}  // namespace rehearse::identification
