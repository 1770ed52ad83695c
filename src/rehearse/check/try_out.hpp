#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/check/try_prior.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::check {

struct Tried {
  Index steps = 0;                 // under random actions, of whole episodes
  Index episodes = 0;              // that were tried
  bool played = false;             // the steps are not of the plant: the first prior plays the robot
  Index ended = 0;                 // episodes that the plant or `ended` ended
  std::vector<Index> limits;       // of each limit: episodes that broke it, which ends them
  std::optional<std::string> end;  // when and why the plant failed; empty: it did not
  Vector change;                   // of each state: root mean square change in a step
  double start_reward = 0;         // of the start, without an action
  std::vector<PriorTried> priors;
  std::vector<std::string> broken;  // laws of plants and simulators, a line each
  std::vector<std::string> notes;   // on what may be wrong with the task, a sentence each
};

/// Use it before anything is learned: tries plant and priors of a scenario on some episodes of random actions. Finds
/// what a learner would stumble over later. The first prior plays the robot where Rehearse does not drive it, or where
/// the plant fails in its first episode. The same for the same seed, but for times. A robot that fails is not moved
/// again. The evaluator is asked before each step whether to stop. Throws InvalidInput, with why, where a program
/// answers nothing.
Tried try_out(const scenario::Scenario& scenario, const Evaluator& evaluator = serial_evaluator(), Index episodes = 3,
              std::uint64_t seed = 1);

}  // namespace rehearse::check
