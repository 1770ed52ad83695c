#pragma once

#include <string>
#include <vector>

#include "rehearse/scenario/scenario.hpp"

namespace rehearse::testing {

/// Steps of episodes on the plant under random policies, θ uniform in [−5, 5].
Dataset random_episodes(const scenario::Scenario& scenario, Index episodes, std::uint64_t seed = 1);

/// The laws of the plant (check_plant), the policy (check_policy), the priors and the oracle (check_simulator, on
/// states that random policies reach), the analytic form of the reward, the descriptor, the drawing, and what is
/// missing in the task. A line for each that is broken.
std::vector<std::string> check_scenario(const scenario::Scenario& scenario);

}  // namespace rehearse::testing
