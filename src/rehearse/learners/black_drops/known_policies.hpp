#pragma once

#include <vector>

#include "rehearse/learners/black_drops/options.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::learners::black_drops {

/// The policies tried so far and what they earned.
struct History {
  std::vector<Vector> policies;  // one a trial; empty: random actions
  std::vector<double> returns;   // −∞ of an episode that was cut short, which is never the best
  bool random_first = false;     // trial 1 was random actions, not a policy

  void earn(const Episode& episode, Index horizon);

  /// The trial, counted from 0, whose policy earned most; empty before there is one.
  std::optional<std::size_t> best() const;
};

/// The policies that descents start from: the best one observed, and examples of the policy.
std::vector<Vector> known_policies(const History& history, const policy::Policy& policy, const Options& options);

}  // namespace rehearse::learners::black_drops
