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

Propagation::Propagation(StepDynamics dynamics, const PolicyMoments& policy, const Evaluator& evaluator)
    : dynamics_(std::move(dynamics)), policy_(policy), evaluator_(evaluator) {
  Violations violations;
  violations.require(static_cast<bool>(dynamics_), "dynamics: there are none");
  const Index least = policy.features() + policy.actions();
  const auto& [gps, prior] = dynamics_;
  violations.require(!gps || gps->inputs() >= least,
                     fmt::format("dynamics: {} inputs, must be ≥ {}, the policy's features and actions",
                                 gps ? gps->inputs() : 0, least));
  violations.require(
      !prior || prior->actions() == policy.actions(),
      fmt::format("prior: {} actions, the policy has {}", prior ? prior->actions() : 0, policy.actions()));
  violations.require(!gps || !prior || gps->outputs() == prior->states(),
                     fmt::format("prior: {} states, the GPs around it have {}", prior ? prior->states() : 0,
                                 gps ? gps->outputs() : 0));
  violations.throw_if_any();
}

bool Propagation::forward(const Gaussian& state, const Transformed& features, StepTape& tape, Gaussian& next) const {
  const Index F = features.outputs(), U = policy_.actions(), P = policy_.features();
  check(state, features, dynamics_.states(), dynamics_.gps ? dynamics_.gps->inputs() - U : F);
  if (!policy_.forward(seen(features, policy_), tape.policy, tape.action, evaluator_)) return false;
  tape.inputs.mean.resize(F + U);
  tape.inputs.mean << features.mean, tape.action.mean;
  const Matrix cross = features.covariance.leftCols(P) * tape.action.gain;
  tape.inputs.covariance.resize(F + U, F + U);
  tape.inputs.covariance << features.covariance, cross, cross.transpose(), tape.action.covariance;
  tape.gain.resize(state.size(), F + U);
  tape.gain << features.gain, features.gain.leftCols(P) * tape.action.gain;
  if (!dynamics_.gps)
    tape.change = Transformed::zero(F + U, state.size());
  else if (!dynamics_.gps->forward(tape.inputs, tape.dynamics, tape.change, evaluator_))
    return false;
  const Matrix with_change = state.covariance * (tape.gain * tape.change.gain);
  next.mean = state.mean + tape.change.mean;
  next.covariance = state.covariance + tape.change.covariance + with_change + with_change.transpose();
  if (dynamics_.prior && !add_prior(state, with_change, tape, next)) return false;
  next.covariance = (next.covariance + next.covariance.transpose()).eval() / 2;
  return next.mean.allFinite() && next.covariance.allFinite();
}

/// With d the prior's change, x̃ of states x and actions: d, cov[x, d] and cov[d, Δ].
bool Propagation::add_prior(const Gaussian& state, const Matrix& state_with_change, StepTape& tape,
                            Gaussian& next) const {
  const Index dx = state.size(), U = policy_.actions();
  const Matrix state_with_action = state.covariance * tape.gain.rightCols(U);
  tape.joint.mean.resize(dx + U);
  tape.joint.mean << state.mean, tape.action.mean;
  tape.joint.covariance.resize(dx + U, dx + U);
  tape.joint.covariance << state.covariance, state_with_action, state_with_action.transpose(), tape.action.covariance;
  tape.with_change.resize(dx + U, dx);
  tape.with_change << state_with_change, tape.inputs.covariance.bottomRows(U) * tape.change.gain;
  if (!dynamics_.prior->forward(tape.joint, tape.prior, tape.prior_change)) return false;
  const Matrix& gain = tape.prior_change.gain;
  const Matrix cross = tape.joint.covariance.topRows(dx) * gain + gain.transpose() * tape.with_change;
  next.mean += tape.prior_change.mean;
  next.covariance += tape.prior_change.covariance + cross + cross.transpose();
  return true;
}

/// next_adjoint: its covariance symmetric.
Propagation::AroundPrior Propagation::prior_adjoint(const StepTape& tape, const Gaussian& next_adjoint) const {
  const Index dx = next_adjoint.size();
  const Matrix by_cross = 2 * next_adjoint.covariance;
  const Matrix& gain = tape.prior_change.gain;
  AroundPrior by{Gaussian::zero(tape.joint.size()), gain * by_cross};
  by.joint.covariance.topRows(dx) += by_cross * gain.transpose();
  dynamics_.prior->adjoint(
      tape.joint, tape.prior, tape.prior_change,
      {next_adjoint.mean, next_adjoint.covariance, (tape.joint.covariance.leftCols(dx) + tape.with_change) * by_cross},
      by.joint);
  return by;
}

void Propagation::adjoint(const Gaussian& state, const Transformed& features, const StepTape& tape,
                          const Gaussian& next_adjoint, StepAdjoint adjoint) const {
  const Index F = features.outputs(), U = policy_.actions(), P = policy_.features(), dx = state.size();
  const Matrix by_next = (next_adjoint.covariance + next_adjoint.covariance.transpose()) / 2;
  Matrix by_with_change = 2 * by_next;
  Gaussian inputs = Gaussian::zero(F + U);
  Matrix by_change_gain = Matrix::Zero(F + U, dx), by_action_gain = Matrix::Zero(dx, U);
  adjoint.state.mean += next_adjoint.mean;
  if (dynamics_.prior) {
    const auto [joint, with_change] = prior_adjoint(tape, {next_adjoint.mean, by_next});
    const auto action_with_change = with_change.bottomRows(U);
    const Matrix with_action =
        joint.covariance.topRightCorner(dx, U) + joint.covariance.bottomLeftCorner(U, dx).transpose();
    adjoint.state.mean += joint.mean.head(dx);
    adjoint.state.covariance +=
        joint.covariance.topLeftCorner(dx, dx) + with_action * tape.gain.rightCols(U).transpose();
    by_with_change += with_change.topRows(dx);
    inputs.mean.tail(U) = joint.mean.tail(U);
    inputs.covariance.bottomRightCorner(U, U) = joint.covariance.bottomRightCorner(U, U);
    inputs.covariance.bottomRows(U) += action_with_change * tape.change.gain.transpose();
    by_change_gain = tape.inputs.covariance.rightCols(U) * action_with_change;
    by_action_gain = state.covariance * with_action;
  }
  adjoint.state.covariance += by_next + by_with_change * (tape.gain * tape.change.gain).transpose();
  const Matrix by_both_gains = state.covariance * by_with_change;  // by tape.gain · change.gain

  if (dynamics_.gps)
    dynamics_.gps->adjoint(tape.inputs, tape.dynamics, tape.change,
                           {next_adjoint.mean, by_next, by_change_gain + tape.gain.transpose() * by_both_gains},
                           inputs);
  const Matrix by_gain = by_both_gains * tape.change.gain.transpose();
  by_action_gain += by_gain.rightCols(U);
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
