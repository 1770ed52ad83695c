#include "rehearse/experiment/evaluation.hpp"

#include "rehearse/rollout/execute.hpp"

namespace rehearse::experiment {

std::optional<double> expected_return(const Resolved& resolved, Index trial, const Vector& theta) {
  const scenario::Scenario& scenario = resolved.scenario;
  if (scenario.evaluations == 0) return std::nullopt;
  const auto plant = scenario.make_plant();
  Vector returns(scenario.evaluations);
  for (Index i = 0; i < returns.size(); ++i) {
    const StreamKey key{.seed = static_cast<std::uint64_t>(resolved.spec.seed),
                        .trial = static_cast<std::uint64_t>(trial),
                        .purpose = Purpose::evaluation,
                        .candidate = static_cast<std::uint64_t>(i)};
    returns(i) = rollout::execute(*plant, *scenario.policy, theta, scenario.task, Rng(key)).total_reward();
  }
  return returns(0) + (returns.array() - returns(0)).mean();  // of equal returns exactly that
}

}  // namespace rehearse::experiment
