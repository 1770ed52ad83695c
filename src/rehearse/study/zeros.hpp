#pragma once
// Zeros of states that differ between logs: an encoder that counts from where it was switched on. Also the φ that
// belongs to them. A wrong zero looks like a force to a model of one step, and ruins what it learns.

#include <optional>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/identification/phi_posterior.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::study {

struct ZeroProblem {
  const prior::Prior& prior;
  std::vector<Index> states;  // whose zeros are unknown; others are right
  double range = 0;           // how far off they may be
  Index horizon = 1;          // control steps, over which predictions are compared with what was measured
  Index starts = 150;         // of predictions, about so many of each log
};

struct Zeros {
  Vector phi;
  Matrix offsets;     // logs × dx: measured + offset is the state that the prior means
  Matrix deviations;  // logs × dx, how sure the offsets are
  std::optional<identification::PhiPosterior> posterior = {};  // of φ
  Vector closest_phi = {};                                     // of the least errors, wherever the logs leave it
  Vector left = {};                                            // dx, as errors_left has them
};

/// The offsets, and the prior's continuous parameters, of the least errors over the horizon, from some states of
/// each log; errors beyond three usual ones count by their logarithm. Parameters that the logs do not tell stay near
/// the prior's values, and zeros where they are. Gauss and Newton's method from the prior's values. Throws InvalidInput
/// if no log is longer than the horizon.
Zeros find_zeros(const std::vector<Episode>& logs, const ZeroProblem& problem, const Evaluator& evaluator);

/// The median magnitudes (dx) of the errors over the horizon that find_zeros leaves. The rest is not computed.
Vector errors_left(const std::vector<Episode>& logs, const ZeroProblem& problem, const Evaluator& evaluator);

/// The log with its states moved by an offset (dx).
Episode moved(Episode log, const Vector& offset);

}  // namespace rehearse::study
