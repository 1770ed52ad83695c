#pragma once

#include <cstdint>

#include "rehearse/core/random.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::identification {

/// The measured steps of one episode of a random policy on the pendubot.
inline Dataset one_episode(const scenario::Scenario& s, std::uint64_t seed) {
  Rng rng({.seed = seed, .purpose = Purpose::random_policy});
  Vector theta(s.policy->parameters());
  for (double& value : theta) value = rng.uniform(-5, 5);
  Dataset data;
  data.append(rollout::execute(*s.make_plant(), *s.policy, theta, s.task, rng));
  return data;
}

}  // namespace rehearse::identification
