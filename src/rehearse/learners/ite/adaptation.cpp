#include "rehearse/learners/ite/adaptation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

namespace rehearse::learners::ite {

void AdaptationOptions::fields(FieldVisitor& v) {
  v.number("length", length, "length scale of the Matérn kernel, in widths of the descriptors' bounds", above(0));
  v.number("signal_variance", signal_variance, "variance of the GP, in squares of the archive's best performance",
           above(0));
  v.number("noise_variance", noise_variance, "variance of an observed performance, in the same unit", at_least(1e-9));
  v.number("kappa", kappa, "weight of the standard deviation in the upper confidence bound (UCB)", at_least(0));
  v.number("stop_ratio", stop_ratio,
           "stop when the best observed return reaches this fraction of the best predicted; 0: never", between(0, 1));
  v.integer("max_trials", max_trials, "stop after so many trials", at_least(1));
}

Adaptation::Adaptation(Matrix descriptors, Vector promised, AdaptationOptions options)
    : descriptors_(std::move(descriptors)),
      promised_(std::move(promised)),
      options_(options),
      means_(promised_),
      deviations_(Vector::Constant(promised_.size(), std::sqrt(options.signal_variance))) {}

Index Adaptation::next() const {
  Index best = 0;
  (means_ + options_.kappa * deviations_).maxCoeff(&best);
  return best;
}

void Adaptation::observe(Index elite, double performance) {
  if (!stopped_.empty()) return;
  tried_.push_back(elite);
  observed_.push_back(performance);
  covariances_.push_back(covariances(elite));
  condition();
  judge();
}

/// σ_f² (1 + √5 r + 5r²/3) exp(−√5 r) with r the distance by ρ (Rasmussen 2006, eq. 4.17).
Vector Adaptation::covariances(Index elite) const {
  const Vector here = descriptors_.col(elite);
  Vector k(promised_.size());
  for (Index i = 0; i < k.size(); ++i) {
    const double s = std::sqrt(5.0) * (descriptors_.col(i) - here).norm() / options_.length;
    k(i) = options_.signal_variance * (1 + s + s * s / 3) * std::exp(-s);
  }
  return k;
}

/// mean = m + C K⁻¹(y − m), variance = σ_f² − diag(C K⁻¹ Cᵀ) (Rasmussen 2006, eqs 2.25, 2.26 and 2.38).
void Adaptation::condition() {
  const auto t = static_cast<Index>(tried_.size());
  Matrix C(promised_.size(), t), K(t, t);
  Vector surprise(t);
  for (Index j = 0; j < t; ++j) {
    const auto trial = static_cast<std::size_t>(j);
    C.col(j) = covariances_[trial];
    surprise(j) = observed_[trial] - promised_(tried_[trial]);
    for (Index i = 0; i < t; ++i) K(i, j) = covariances_[trial](tried_[static_cast<std::size_t>(i)]);
    K(j, j) += options_.noise_variance;
  }
  const Eigen::LLT<Matrix> factor(K);  // noise_variance keeps it positive definite
  means_ = promised_ + C * factor.solve(surprise);
  const Matrix explained = factor.matrixL().solve(C.transpose());
  deviations_ = (options_.signal_variance - explained.colwise().squaredNorm().array()).max(0).sqrt();
}

void Adaptation::judge() {
  const double best = *std::max_element(observed_.begin(), observed_.end()), expected = means_.maxCoeff();
  if (options_.stop_ratio > 0 && expected > 0 && best >= options_.stop_ratio * expected)
    stopped_ =
        fmt::format("after trial {} the best observed is {:.3g} of the largest predicted", trials(), best / expected);
  else if (trials() >= options_.max_trials)
    stopped_ = fmt::format("after trial {}: adaptation.max_trials", trials());
}

}  // namespace rehearse::learners::ite
