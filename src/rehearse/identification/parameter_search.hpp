#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "rehearse/core/parameters.hpp"
#include "rehearse/optim/derivative_free.hpp"

namespace rehearse::identification {

/// Every combination of the values of these discrete parameters.
std::vector<Vector> choices_of(const ParameterSpace& space, const std::vector<Index>& discrete);

struct Identified {
  Vector phi;
  double score = 0;
  Index evaluations = 0;
};

/// The φ of the highest score: every combination of the discrete parameters is tried, and for each of them the
/// continuous ones are searched locally from `start` (else the space's own values). Fixed ones stay.
Identified identify(const ParameterSpace& space, const std::optional<Vector>& start,
                    const optim::ScalarObjective& score, const optim::SubplexOptions& options);

}  // namespace rehearse::identification
