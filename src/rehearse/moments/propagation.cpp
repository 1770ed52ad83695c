#include "rehearse/moments/propagation.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::moments {
namespace {

/// The features that the policy sees.
Gaussian seen(const Transformed& features, const PolicyMoments& policy) {
  const Index n = policy.features();
  return {features.mean.head(n), features.covariance.topLeftCorner(n, n)};
}

void check(const Gaussian& state, const Transformed& features, Index states, Index wanted) {
  const Index dx = state.size(), F = features.outputs();
  const bool agree = state.covariance.rows() == dx && state.covariance.cols() == dx &&
                     features.covariance.rows() == F && features.covariance.cols() == F && features.gain.rows() == dx &&
                     features.gain.cols() == F;
  if (dx != states || F != wanted || !agree)
    throw InvalidInput(fmt::format("propagation: {} states and {} features{}, must be {} and {}", dx, F,
                                   agree ? "" : " whose covariances have other sizes", states, wanted));
}

}  // namespace

Propagation::Propagation(const MomentMatching& dynamics, const PolicyMoments& policy, const Evaluator& evaluator)
    : dynamics_(dynamics), policy_(policy), evaluator_(evaluator) {
  const Index least = policy.features() + policy.actions();
  if (dynamics.inputs() < least)
    throw InvalidInput(
        fmt::format("dynamics: {} inputs, must be ≥ {}, the policy's features and actions", dynamics.inputs(), least));
}

bool Propagation::forward(const Gaussian& state, const Transformed& features, StepTape& tape, Gaussian& next) const {
  const Index F = features.outputs(), U = policy_.actions(), P = policy_.features();
  check(state, features, dynamics_.outputs(), dynamics_.inputs() - U);
  if (!policy_.forward(seen(features, policy_), tape.policy, tape.action, evaluator_)) return false;
  tape.inputs.mean.resize(F + U);
  tape.inputs.mean << features.mean, tape.action.mean;
  const Matrix cross = features.covariance.leftCols(P) * tape.action.gain;
  tape.inputs.covariance.resize(F + U, F + U);
  tape.inputs.covariance << features.covariance, cross, cross.transpose(), tape.action.covariance;
  tape.gain.resize(state.size(), F + U);
  tape.gain << features.gain, features.gain.leftCols(P) * tape.action.gain;
  if (!dynamics_.forward(tape.inputs, tape.dynamics, tape.change, evaluator_)) return false;
  const Matrix with_change = state.covariance * (tape.gain * tape.change.gain);
  next.mean = state.mean + tape.change.mean;
  next.covariance = state.covariance + tape.change.covariance + with_change + with_change.transpose();
  next.covariance = (next.covariance + next.covariance.transpose()).eval() / 2;
  return next.mean.allFinite() && next.covariance.allFinite();
}

void Propagation::adjoint(const Gaussian& state, const Transformed& features, const StepTape& tape,
                          const Gaussian& next_adjoint, StepAdjoint adjoint) const {
  const Index F = features.outputs(), U = policy_.actions(), P = policy_.features();
  const Matrix by_next = (next_adjoint.covariance + next_adjoint.covariance.transpose()) / 2;
  adjoint.state.mean += next_adjoint.mean;
  adjoint.state.covariance += by_next + 2 * by_next * (tape.gain * tape.change.gain).transpose();
  const Matrix by_both_gains = 2 * state.covariance * by_next;  // by tape.gain · change.gain

  Gaussian inputs = Gaussian::zero(F + U);
  dynamics_.adjoint(tape.inputs, tape.dynamics, tape.change,
                    {next_adjoint.mean, by_next, tape.gain.transpose() * by_both_gains}, inputs);
  const Matrix by_gain = by_both_gains * tape.change.gain.transpose();
  const auto by_action_gain = by_gain.rightCols(U);
  const Matrix by_cross = inputs.covariance.topRightCorner(F, U) + inputs.covariance.bottomLeftCorner(U, F).transpose();

  const Transformed action{
      inputs.mean.tail(U), inputs.covariance.bottomRightCorner(U, U),
      features.covariance.topRows(P) * by_cross + features.gain.leftCols(P).transpose() * by_action_gain};
  Gaussian of_seen = Gaussian::zero(P);
  policy_.adjoint(seen(features, policy_), tape.policy, action, of_seen, adjoint.policy);
  adjoint.features.mean += inputs.mean.head(F);
  adjoint.features.mean.head(P) += of_seen.mean;
  adjoint.features.covariance += inputs.covariance.topLeftCorner(F, F);
  adjoint.features.covariance.topLeftCorner(P, P) += of_seen.covariance;
  adjoint.features.covariance.leftCols(P) += by_cross * tape.action.gain.transpose();
  adjoint.features.gain += by_gain.leftCols(F);
  adjoint.features.gain.leftCols(P) += by_action_gain * tape.action.gain.transpose();
}

}  // namespace rehearse::moments
