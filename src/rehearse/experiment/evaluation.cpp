#include "rehearse/experiment/evaluation.hpp"

#include <cstring>

#include <fmt/format.h>

#include "rehearse/rollout/execute.hpp"

namespace rehearse::experiment {
namespace {

double return_of_episode(const Resolved& resolved, system::Plant& plant, Index trial, const Vector& theta,
                         Index episode) {
  const StreamKey key{.seed = static_cast<std::uint64_t>(resolved.spec.seed),
                      .trial = static_cast<std::uint64_t>(trial),
                      .purpose = Purpose::evaluation,
                      .candidate = static_cast<std::uint64_t>(episode)};
  const scenario::Scenario& scenario = resolved.scenario;
  return rollout::execute(plant, *scenario.policy, theta, scenario.task, Rng(key)).total_reward();
}

/// What `number` returns on rank 0, on every rank.
double once(const Evaluator& evaluator, const std::string& step, const std::function<double()>& number) {
  double value = 0;
  const std::string bytes = evaluator.once(step, [&] {
    value = number();
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  });
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

}  // namespace

std::optional<double> expected_return(const Resolved& resolved, Index trial, const Vector& theta,
                                      const Evaluator& evaluator, const std::function<void()>& before_each) {
  const scenario::Scenario& scenario = resolved.scenario;
  if (scenario.evaluations == 0) return std::nullopt;
  std::unique_ptr<system::Plant> plant;
  Vector returns(scenario.evaluations);
  for (Index i = 0; i < returns.size(); ++i) {
    before_each();
    returns(i) = once(evaluator, fmt::format("evaluation {} of trial {}", i + 1, trial), [&] {
      if (!plant) plant = scenario.make_plant();
      return return_of_episode(resolved, *plant, trial, theta, i);
    });
  }
  return returns(0) + (returns.array() - returns(0)).mean();  // of equal returns exactly that
}

}  // namespace rehearse::experiment
