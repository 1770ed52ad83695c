#include "rehearse/learners/pilco/initial_policy.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/feature_moments.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"

namespace rehearse::learners::pilco {
namespace {

constexpr double kLength = 1, kAngleLength = 0.7, kTargetStd = 0.1;  // PILCO's cart-pole
constexpr double kWeightStd = 0.01;                                  // of PILCO's linear policies

Index size_of(const std::vector<Interval>& bounds) { return static_cast<Index>(bounds.size()); }

/// One a feature.
Vector initial_lengths(const FeatureMap& features) {
  Vector lengths(features.features());
  Index next = 0;
  for (const StateKind kind : features.kinds()) {
    if (kind == StateKind::plain) lengths(next++) = kLength;
    if (kind == StateKind::angle) lengths.segment(next, 2).setConstant(kAngleLength), next += 2;
  }
  return lengths;
}

Vector units(const policy::RbfOptions& rbf) {
  const Index D = rbf.scale.size(), A = size_of(rbf.bounds);
  Vector units = Vector::Ones(A * D + rbf.centres * (D + A));
  units.segment(A * D, rbf.centres * D) = rbf.scale.cwiseInverse().replicate(rbf.centres, 1);
  return units;
}

Vector units(const policy::LinearOptions& linear) {
  Vector of_action(linear.scale.size() + 1);
  of_action << linear.scale, 1;
  return (of_action / linear.squash.gain).replicate(size_of(linear.squash.bounds), 1);
}

Vector initial(const policy::RbfOptions& rbf, const moments::Gaussian& start, Rng& rng) {
  const moments::Transformed features = moments::FeatureMoments(rbf.features)(start);
  const Vector lengths = initial_lengths(rbf.features).cwiseQuotient(rbf.scale);
  const Index D = rbf.scale.size(), A = size_of(rbf.bounds);
  Vector theta(A * D + rbf.centres * (D + A));
  theta.head(A * D) = lengths.array().log().matrix().replicate(A, 1);
  for (Index c = 0; c < rbf.centres; ++c)
    for (Index d = 0; d < D; ++d) {
      const double deviation = std::sqrt(std::max(features.covariance(d, d), 0.0));
      theta((A + c) * D + d) = (features.mean(d) + deviation * rng.normal()) / rbf.scale(d);
    }
  for (double& target : theta.tail(A * rbf.centres)) target = kTargetStd * rng.normal();
  return theta;
}

Vector initial(const policy::LinearOptions& linear, const moments::Gaussian&, Rng& rng) {
  Vector theta = units(linear);
  const Index each = linear.scale.size() + 1;
  for (Index i = 0; i < theta.size(); ++i) theta(i) *= i % each == each - 1 ? 0 : kWeightStd * rng.normal();
  return theta;
}

}  // namespace

Vector initial_policy(const policy::Policy& policy, const moments::Gaussian& start, StreamKey key) {
  key.purpose = Purpose::random_policy;
  Rng rng(key);
  return std::visit([&](const auto* options) { return initial(*options, start, rng); },
                    moments::analytic_options(policy).value());
}

Vector units_of(const policy::Policy& policy) {
  return std::visit([](const auto* options) { return units(*options); }, moments::analytic_options(policy).value());
}

}  // namespace rehearse::learners::pilco
