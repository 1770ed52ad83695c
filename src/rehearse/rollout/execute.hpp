#pragma once

#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/system/plant.hpp"

namespace rehearse::rollout {

/// One episode on the plant. Rewards and the end use the noise-free state where the plant knows it. If the plant
/// throws or returns a state that is not finite, that exception (or InvalidInput) reaches the caller: a real robot's
/// silence is not a fall.
Episode execute(system::Plant& plant, const policy::Policy& policy, const Vector& theta, const Task& task, Rng rng);

}  // namespace rehearse::rollout
