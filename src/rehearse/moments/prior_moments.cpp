#include "rehearse/moments/prior_moments.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::moments {

bool PriorMoments::ask(const Matrix& points, Matrix& changes) const {
  changes.resize(points.rows(), states_);
  prior_.mean(points.leftCols(states_), points.rightCols(actions_), phi_, changes);
  return changes.allFinite();
}

bool PriorMoments::forward(const Gaussian& input, PriorTape& tape, Transformed& change) const {
  const Index n = inputs(), rows = input.covariance.rows(), columns = input.covariance.cols();
  if (input.size() != n || rows != n || columns != n)
    throw InvalidInput(fmt::format("prior: {} states and actions and a covariance of {} × {}, must be {} and {} × {}",
                                   input.size(), rows, columns, n, n, n));
  if (!input.mean.allFinite() || !input.covariance.allFinite()) return false;
  if (!place(input, tape) || !ask(tape.points, tape.changes)) return false;
  combine(tape, change);
  change.covariance += change.gain.transpose() * input.covariance * change.gain;
  return change.mean.allFinite() && change.covariance.allFinite() && change.gain.allFinite();
}

bool PriorMoments::differentiate(const std::vector<PriorTape*>& tapes) const {
  const Index each = neighbours();
  Matrix points(each * static_cast<Index>(tapes.size()), inputs()), changes;
  Index next = 0;
  for (const PriorTape* tape : tapes) place_neighbours(*tape, points.middleRows(each * next++, each));
  const bool ok = ask(points, changes);
  next = 0;
  for (PriorTape* tape : tapes) {
    tape->neighbours = points.middleRows(each * next, each);
    tape->nearby = changes.middleRows(each * next++, each);
  }
  return ok;
}

/// The covariance is gainᵀ s gain, s that of the input, and what `combine` adds.
void PriorMoments::adjoint(const Gaussian& input, const PriorTape& tape, const Transformed& change,
                           const Transformed& adjoint, Gaussian& input_adjoint) const {
  const Matrix symmetric = adjoint.covariance + adjoint.covariance.transpose();
  input_adjoint.covariance += change.gain * adjoint.covariance * change.gain.transpose();
  combine_adjoint(tape, change,
                  {adjoint.mean, symmetric / 2, adjoint.gain + input.covariance * change.gain * symmetric},
                  input_adjoint);
}

}  // namespace rehearse::moments
