#pragma once
// Scenarios of simulated robots that are one differential equation: the plant integrates it adaptively, priors and
// oracle are the same equation, vectorised, at other parameters.

#include <functional>
#include <string>
#include <vector>

#include "rehearse/scenario/scenario.hpp"
#include "rehearse/system/ode.hpp"

namespace rehearse::scenario {

struct Guess {
  std::string name;
  ParameterSpace parameters;  // values, and which may be tuned
};

struct OdeScenario {
  std::string name;
  Task task;
  system::OdeKernel kernel;
  ParameterSpace plant;          // all fixed, at the truth
  double measurement_noise = 0;  // std of every measured state
  std::vector<Guess> guesses;
  Index substeps = 20;  // of priors and oracle in a control step
  std::shared_ptr<const policy::Policy> policy;
  std::optional<Drawing> drawing;
};
Scenario make_ode_scenario(const OdeScenario& parts);

/// For Task::solved: whether the whole horizon was run and every true state of its last `seconds` is as it should be.
std::function<bool(const Episode&)> holds_at_the_end(const Task& task, double seconds,
                                                     std::function<bool(const ConstVectorView& state)> holds);

}  // namespace rehearse::scenario
