#pragma once

#include <vector>

#include "rehearse/learners/black_drops/simulated_return.hpp"

namespace rehearse::learners::black_drops {

/// The space of a search by gradient: every number of θ in `interval`. Descents begin at the starts, further ones at
/// points uniform in a part of it.
struct GradientSpace {
  Interval interval;
  const std::vector<Vector>& starts;
};

/// Good policies, best first: the descents that went on to the end, then those that were given up, the last first. Each
/// step has fresh random numbers. `key` names the search's own. Policies of the problem are policy::Differentiable.
std::vector<Vector> search_by_gradient(SimulatedReturn& objective, const policy::Policy& policy,
                                       const GradientSpace& space, const GradientOptions& options, const StreamKey& key,
                                       const optim::SearchListener& listener = {});

}  // namespace rehearse::learners::black_drops
