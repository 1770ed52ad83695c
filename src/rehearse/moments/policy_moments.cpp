#include "rehearse/moments/policy_moments.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::moments {
bool PolicyMoments::forward(const Gaussian& features, PolicyTape& tape, Transformed& action,
                            const Evaluator& evaluator) const {
  const Index rows = features.covariance.rows(), columns = features.covariance.cols();
  if (features.size() != features_ || rows != features_ || columns != features_)
    throw InvalidInput(fmt::format("policy: {} features and a covariance of {} × {}, must be {} and {} × {}",
                                   features.size(), rows, columns, features_, features_, features_));
  if (!forward_before(features, tape, evaluator)) return false;
  tape.squash = squash_({tape.before.mean, tape.before.covariance});
  action.mean = tape.squash.mean;
  action.covariance = tape.squash.covariance;
  action.gain = tape.before.gain * tape.squash.gain;
  return action.mean.allFinite() && action.covariance.allFinite() && action.gain.allFinite();
}

void PolicyMoments::adjoint(const Gaussian& features, const PolicyTape& tape, const Transformed& adjoint,
                            Gaussian& features_adjoint, PolicyAdjoint& policy) const {
  Gaussian before = Gaussian::zero(adjoint.outputs());
  squash_.adjoint({tape.before.mean, tape.before.covariance},
                  {adjoint.mean, adjoint.covariance, tape.before.gain.transpose() * adjoint.gain}, before);
  adjoint_before(features, tape, {before.mean, before.covariance, adjoint.gain * tape.squash.gain.transpose()},
                 features_adjoint, policy);
}

}  // namespace rehearse::moments
