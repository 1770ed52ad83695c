#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robot_file {

/// The errors of a prior on the plant's steps.
struct PriorTried {
  std::string name;
  Index states = 0;                // on which parameters were tried: those of the steps, and others around them
  Vector error;                    // of each state: root mean square error of its change in a step; NaN: no prediction
  Index failed = 0;                // rows without a prediction
  double rows_per_s = 0;           // on one thread
  std::vector<std::string> idle;   // tunable parameters that change no prediction
  std::string broken;              // the law of simulators that it breaks; empty: none
  std::vector<std::string> notes;  // on what may be wrong, a sentence each
};

struct Tried {
  Index steps = 0;                 // of the plant, under random actions
  Index episodes = 0;              // that were tried
  Index ended = 0;                 // episodes that the plant or `ended` ended
  std::vector<Index> limits;       // of each limit: episodes that broke it, which ends them
  std::optional<std::string> end;  // why an episode was cut short; empty: none was
  Vector change;                   // of each state: root mean square change in a step
  double start_reward = 0;         // of the start, without an action
  std::vector<PriorTried> priors;
  std::vector<std::string> broken;  // laws of plants and simulators, a line each
  std::vector<std::string> notes;   // on what may be wrong with the task, a sentence each
};

/// Use it before anything is learned: tries plant and priors of a scenario on some episodes of random actions. Finds
/// what a learner would stumble over later. The first prior plays the robot where Rehearse does not drive it. The same
/// for the same seed, but for times. A robot that fails is not moved again. The evaluator is asked before each step
/// whether to stop. Throws InvalidInput, with why, where a program answers nothing.
Tried try_out(const scenario::Scenario& scenario, const Evaluator& evaluator = serial_evaluator(), Index episodes = 3,
              std::uint64_t seed = 1);

}  // namespace rehearse::robot_file
