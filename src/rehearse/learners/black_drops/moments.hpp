#pragma once
// Where policies of Black-DROPS can be followed by moment matching (docs/pilco.md), and in what.

#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/learners/black_drops/black_drops.hpp"
#include "rehearse/moments/moment_matching.hpp"

namespace rehearse::learners::black_drops {

/// What of a learner with these options has no analytic moments, and what to use instead, a line each; empty: all has.
std::vector<std::string> without_moments(const Options& options, const Task& task, const policy::Policy& policy);

/// The GPs of all rows with these kernels, of a learner with these options, whose parts all have moments.
std::shared_ptr<const moments::MomentMatching> moments_of(const Options& options, const Task& task, const Dataset& data,
                                                          const std::vector<gp::Hyperparameters>& kernels);

}  // namespace rehearse::learners::black_drops
