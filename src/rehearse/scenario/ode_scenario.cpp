#include "rehearse/scenario/ode_scenario.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/core/errors.hpp"

namespace rehearse::scenario {
namespace {

void visit_substeps(FieldVisitor& v, Index& substeps) {
  v.integer("substeps", substeps, expert("integration steps per control step, of priors and oracle"), between(1, 1e4));
}

void visit_evaluations(FieldVisitor& v, Index& evaluations) {
  v.integer("evaluations", evaluations, "extra episodes for each trial's expected_return; 0: none", between(0, 1e6));
}

}  // namespace

void OdeOptions::fields(FieldVisitor& v) {
  v.number("start_noise", start_noise, "standard deviation of every state at the start [its unit]", at_least(0));
  v.number("measurement_noise", measurement_noise,
           "standard deviation of the measurement noise of every state [its unit]", at_least(0));
  visit_substeps(v, substeps);
  fields_of_learning(v);
  policy.fields(v);
}

void OdeOptions::fields_of_learning(FieldVisitor& v) {
  v.number("box_low", box_low, "lower bound of the prior's tunable parameters [their unit]", at_least(0));
  v.number("box_high", box_high, "upper bound of the prior's tunable parameters [their unit]", above(0));
  v.number("initial_reward_width", initial_reward_width,
           "width of the initial guess of the reward when it is learned; 0: no guess", at_least(0));
  visit_evaluations(v, evaluations);
}

void OdeOptions::fields_of_robot(FieldVisitor& v, std::vector<Parameter>& plant) {
  for (Parameter& parameter : plant) {
    const std::string help = "of the robot" + (parameter.unit.empty() ? "" : " [" + parameter.unit + "]");
    v.number("plant." + parameter.name, parameter.value, help.c_str());
  }
  if (measurement_noises.empty())
    v.number("measurement_noise", measurement_noise,
             "standard deviation of the measurement noise of every state [its unit]", at_least(0));
  for (Parameter& noise : measurement_noises)
    v.number("measurement_noise." + noise.name, noise.value,
             "standard deviation of the state's measurement noise [its unit]", at_least(0));
  visit_substeps(v, substeps);
  visit_evaluations(v, evaluations);
  policy.fields(v);
}

Interval OdeOptions::box() const {
  if (!(box_low < box_high))
    throw InvalidInput("box_low = " + to_text(box_low) + ", must be < box_high = " + to_text(box_high));
  return {box_low, box_high};
}

Vector OdeOptions::measurement_std(Index states) const {
  if (measurement_noises.empty()) return Vector::Constant(states, measurement_noise);
  Vector std(states);
  std::transform(measurement_noises.begin(), measurement_noises.end(), std.begin(),
                 [](const Parameter& noise) { return noise.value; });
  return std;
}

Scenario make_ode_scenario(const OdeScenario& parts, const OdeOptions& options) {
  const Task& task = parts.task;
  parts.kernel.require_sizes(task.state_size(), task.action_size(), parts.plant.size());
  const auto simulator = [&](const system::OdeKernel& kernel, const ParameterSpace& parameters) {
    return system::make_ode_simulator(kernel, parameters.fixed_at(parameters.values()), task.dt_s, options.substeps);
  };
  const system::OdePlantOptions plant{
      .ode = parts.kernel.ode(),
      .phi = parts.plant.values(),
      .dt_s = task.dt_s,
      .around = {task.start_mean, task.start_std, options.measurement_std(task.state_size())}};
  Scenario scenario{.name = parts.name,
                    .task = task,
                    .make_plant = [plant] { return system::make_ode_plant(plant); },
                    .oracle = simulator(parts.kernel, parts.plant),
                    .policy = make_policy(options.policy, task, parts.policy_scale),
                    .drawing = parts.drawing,
                    .evaluations = options.evaluations};
  for (const Guess& guess : parts.guesses)
    scenario.priors.push_back(
        {guess.name, simulator(guess.kernel.value_or(parts.kernel), guess.parameters), guess.parameters});
  return scenario;
}

Reward initial_reward(const reward::SquaredDistance& squared_distance, const OdeOptions& options) {
  return options.initial_reward_width > 0 ? reward::saturating(squared_distance, options.initial_reward_width)
                                          : Reward{};
}

Limit limit_within(const StateVariable& state, Index index, double bound, double risk) {
  const auto holds = [index, bound](const Steps& steps, VectorView kept) {
    kept = (steps.X_next.col(index).array().abs() < bound).cast<double>();
  };
  return {state.name, "abs(" + state.name + ") < " + to_text(bound) + " " + state.unit, holds, risk};
}

std::function<bool(const Episode&)> holds_at_the_end(const Task& task, double seconds, StateCondition holds) {
  const Index horizon = task.horizon;
  const Index first = std::max<Index>(0, horizon - std::lround(seconds / task.dt_s));
  return [=, holds = std::move(holds)](const Episode& episode) {
    if (episode.steps() < horizon || episode.ended) return false;
    Vector values(horizon + 1 - first);
    holds(episode.true_states.bottomRows(values.size()), values);
    return (values.array().abs() > 0).all();
  };
}

}  // namespace rehearse::scenario
