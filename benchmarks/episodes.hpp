#pragma once
// The data that benchmarks learn from.

#include "rehearse/core/random.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::benchmarks {

inline Vector random_theta(const policy::Policy& policy, Rng& rng) {
  return Vector::NullaryExpr(policy.parameters(), [&] { return rng.uniform(-5, 5); });
}

/// The first `rows` steps that random policies make on the plant.
inline Dataset random_episodes(const scenario::Scenario& scenario, Index rows, std::uint64_t seed = 1) {
  Dataset data;
  const auto plant = scenario.make_plant();
  for (std::uint64_t e = 0; data.size() < rows; ++e) {
    Rng rng({.seed = seed, .trial = e, .purpose = Purpose::random_policy});
    const Vector theta = random_theta(*scenario.policy, rng);
    data.append(rollout::execute(*plant, *scenario.policy, theta, scenario.task, rng));
  }
  return {data.states.topRows(rows), data.actions.topRows(rows), data.changes.topRows(rows)};
}

}  // namespace rehearse::benchmarks
