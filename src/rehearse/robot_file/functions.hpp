#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::robot_file {

/// Functions of a program, by the names that a robot's file has for them: "@NAME" where a formula may stand, and
/// `function = "NAME"` in [dynamics.NAME] and [plant]. The program alone can use such a file, since no file keeps its
/// functions. Each must keep the promises of its type.
struct Functions {
  std::map<std::string, Reward> of_steps;                                    // reward.formula
  std::map<std::string, StepCondition> limits;                               // limit.keep
  std::map<std::string, StateCondition> of_states;                           // ended, success.when
  std::map<std::string, std::function<double(const Episode&)>> of_episodes;  // reward.episode
  std::map<std::string, system::Change> dynamics;
  std::map<std::string, std::function<std::unique_ptr<system::Plant>()>> plants;
  Index rows_at_once = 0;  // that a call should have to be worth its cost (system::Simulator)
  // Missing functions are no violations, and throw InvalidInput when they are called: for commands that simulate
  // nothing.
  bool only_look = false;
};

/// "'NAME' is a function of the program that wrote this file, …"
std::string missing_function(const std::string& name);

/// The function of that name; where there is none, one that throws InvalidInput.
template <class Result, class... Arguments>
std::function<Result(Arguments...)> function_of(const std::map<std::string, std::function<Result(Arguments...)>>& known,
                                                const std::string& name) {
  if (const auto found = known.find(name); found != known.end()) return found->second;
  return [name](Arguments...) -> Result { throw InvalidInput(missing_function(name)); };
}

}  // namespace rehearse::robot_file
