#include "rehearse/experiment/expected_return.hpp"

#include <memory>

#include "rehearse/experiment/past_run.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::experiment {
namespace {

double return_of_episode(const Resolved& resolved, system::Plant& plant, const policy::Policy& policy,
                         const TrialRecord& trial, Index episode, const Evaluator& evaluator) {
  const StreamKey key{.seed = static_cast<std::uint64_t>(resolved.spec.seed),
                      .trial = static_cast<std::uint64_t>(trial.trial),
                      .stage = Stage::evaluation,
                      .purpose = Purpose::start_state,
                      .candidate = static_cast<std::uint64_t>(episode)};
  const auto ask = [&] { evaluator.stop_if_asked(); };
  return rollout::execute(plant, policy, trial.theta, resolved.scenario.task, Rng(key), ask).total_reward();
}

}  // namespace

std::optional<double> expected_return(const Resolved& resolved, const TrialRecord& trial, const Evaluator& evaluator) {
  const scenario::Scenario& scenario = resolved.scenario;
  if (scenario.evaluations == 0 || !scenario.make_plant) return std::nullopt;
  const auto policy = policy_of(trial, scenario);
  std::unique_ptr<system::Plant> plant;
  Vector returns(scenario.evaluations);
  for (Index i = 0; i < returns.size(); ++i) {
    evaluator.stop_if_asked();
    if (!plant) plant = scenario.make_plant();
    returns(i) = return_of_episode(resolved, *plant, *policy, trial, i, evaluator);
  }
  plant->require_finished();
  return returns(0) + (returns.array() - returns(0)).mean();  // of equal returns exactly that
}

}  // namespace rehearse::experiment
