#pragma once
// Scenarios of simulated robots that are one differential equation: the plant integrates it adaptively, the oracle is
// the same equation, vectorised, and priors are it at other parameters, or another one.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/reward/saturating.hpp"
#include "rehearse/scenario/policy_options.hpp"
#include "rehearse/scenario/scenario.hpp"
#include "rehearse/system/ode.hpp"

namespace rehearse::scenario {

/// Options of every such scenario.
struct OdeOptions {
  double start_noise = 0;                          // std of every state at the start
  double measurement_noise = 0;                    // std of every measured state
  std::vector<Parameter> measurement_noises = {};  // instead, one a state, with its name; empty: as above
  double box_low = 0.05;                           // of the parameters that may be tuned
  double box_high = 1.2;
  Index substeps = 20;              // of priors and oracle in a control step
  double initial_reward_width = 0;  // of the guess that stands in for a reward still to be learned; 0: none
  Index evaluations = 0;            // extra episodes for each trial's expected_return; the authors' code: 500
  PolicyOptions policy;

  /// The bounds of all parameters that may be tuned. Throws InvalidInput where they are none, once for all of them.
  Interval box() const;
  Vector measurement_std(Index states) const;
  void fields(FieldVisitor& v);

  /// Those of `fields` that change no episode of a policy: they are of what is learned, and of how.
  void fields_of_learning(FieldVisitor& v);

  /// Fields in the place of `fields`, for a robot without options of its own: `plant.NAME` for each parameter of the
  /// plant, measurement_noise or measurement_noise.STATE for each state, substeps, evaluations, those of the policy.
  void fields_of_robot(FieldVisitor& v, std::vector<Parameter>& plant);
};

struct Guess {
  std::string name;
  ParameterSpace parameters;                     // values, and which may be tuned
  std::optional<system::OdeKernel> kernel = {};  // an equation of its own; empty: the plant's
};

struct OdeScenario {
  std::string name;
  Task task;
  system::OdeKernel kernel;
  ParameterSpace plant;  // all fixed, at the truth
  std::vector<Guess> guesses;
  Vector policy_scale;  // what the policy's inputs are divided by, one a feature
  std::optional<Drawing> drawing = {};
};
Scenario make_ode_scenario(const OdeScenario& parts, const OdeOptions& options);

/// For Task::initial_reward: saturating as the reward is, with a width of its own; empty if the options give none.
Reward initial_reward(const reward::SquaredDistance& squared_distance, const OdeOptions& options);

/// For Task::limits: |state| < bound, of the state of this index; it has the state's name.
Limit limit_within(const StateVariable& state, Index index, double bound, double risk);

/// For Task::solved: true if the whole horizon was run and the condition holds in every true state of its last
/// `seconds`.
std::function<bool(const Episode&)> holds_at_the_end(const Task& task, double seconds, StateCondition holds);

}  // namespace rehearse::scenario
