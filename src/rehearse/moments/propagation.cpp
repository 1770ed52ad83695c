#include "rehearse/moments/propagation.hpp"

namespace rehearse::moments {

bool Propagation::forward(const Gaussian& state, const Transformed& features, StepTape& tape, Gaussian& next) const {
  if (!policy_.forward({features.mean, features.covariance}, tape.policy, tape.action, evaluator_)) return false;
  const Index F = features.outputs(), U = tape.action.outputs();
  tape.inputs.mean.resize(F + U);
  tape.inputs.mean << features.mean, tape.action.mean;
  const Matrix cross = features.covariance * tape.action.gain;
  tape.inputs.covariance.resize(F + U, F + U);
  tape.inputs.covariance << features.covariance, cross, cross.transpose(), tape.action.covariance;
  tape.gain.resize(state.size(), F + U);
  tape.gain << features.gain, features.gain * tape.action.gain;
  if (!dynamics_.forward(tape.inputs, tape.dynamics, tape.change, evaluator_)) return false;
  const Matrix with_change = state.covariance * (tape.gain * tape.change.gain);
  next.mean = state.mean + tape.change.mean;
  next.covariance = state.covariance + tape.change.covariance + with_change + with_change.transpose();
  next.covariance = (next.covariance + next.covariance.transpose()).eval() / 2;
  return next.mean.allFinite() && next.covariance.allFinite();
}

void Propagation::adjoint(const Gaussian& state, const Transformed& features, const StepTape& tape,
                          const Gaussian& next_adjoint, Gaussian& state_adjoint, Transformed& features_adjoint,
                          PolicyAdjoint& policy) const {
  const Index F = features.outputs(), U = tape.action.outputs();
  const Matrix by_next = (next_adjoint.covariance + next_adjoint.covariance.transpose()) / 2;
  state_adjoint.mean += next_adjoint.mean;
  state_adjoint.covariance += by_next + 2 * by_next * (tape.gain * tape.change.gain).transpose();
  const Matrix by_both_gains = 2 * state.covariance * by_next;  // by tape.gain · change.gain

  Gaussian inputs = Gaussian::zero(F + U);
  dynamics_.adjoint(tape.inputs, tape.dynamics, tape.change,
                    {next_adjoint.mean, by_next, tape.gain.transpose() * by_both_gains}, inputs);
  const Matrix by_gain = by_both_gains * tape.change.gain.transpose();
  const auto by_action_gain = by_gain.rightCols(U);
  const Matrix by_cross = inputs.covariance.topRightCorner(F, U) + inputs.covariance.bottomLeftCorner(U, F).transpose();

  const Transformed action{inputs.mean.tail(U), inputs.covariance.bottomRightCorner(U, U),
                           features.covariance * by_cross + features.gain.transpose() * by_action_gain};
  Gaussian of_features = Gaussian::zero(F);
  policy_.adjoint({features.mean, features.covariance}, tape.policy, action, of_features, policy);
  features_adjoint.mean += inputs.mean.head(F) + of_features.mean;
  features_adjoint.covariance +=
      inputs.covariance.topLeftCorner(F, F) + of_features.covariance + by_cross * tape.action.gain.transpose();
  features_adjoint.gain += by_gain.leftCols(F) + by_action_gain * tape.action.gain.transpose();
}

}  // namespace rehearse::moments
