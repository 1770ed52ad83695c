#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "python/bindings/calls.hpp"
#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/robot_file/functions.hpp"

namespace rehearse::python {

/// A robot as Python describes it: a built-in one by its name, or the text of a robot's file with the functions that it
/// names.
class Robot {
 public:
  /// text: of a file (docs/own-robot.md); source: its name, for messages; folder: where the files are that it names.
  Robot(std::string text, std::string source, std::string folder);

  /// The reward: function(states, actions, next_states) → n numbers.
  void add_step_function(const std::string& name, py::object function);
  /// A limit: function(states, actions, next_states, actions_before, time_s) → n truths.
  void add_step_condition(const std::string& name, py::object function);
  /// ended, success: function(states) → n truths.
  void add_state_function(const std::string& name, py::object function);
  /// The reward of a whole episode: function(states, actions) → a number; T + 1 and T rows.
  void add_episode_function(const std::string& name, py::object function);
  /// function(states, actions, **parameters) → changes of the states, n × dx.
  void add_dynamics(const std::string& name, py::object function, const std::vector<std::string>& parameters);
  /// make() → an object with reset(seed) → state and step(action) → (state, ended).
  void add_plant(const std::string& name, py::object make);

  /// The same robot, whose functions keep their exceptions in a Failure of its own: for one piece of work, of which
  /// there may be several at once.
  Robot for_work() const;

  /// The built-in robots and learners, with this robot; one without text adds its functions alone.
  experiment::Catalogue catalogue() const;

  /// The catalogue to look at a run and simulate nothing: functions may be missing.
  experiment::Catalogue to_look() const;

  /// Facts of the robot's file, as keywords of Python's State and Action where it is a list of them. Throws
  /// InvalidInput.
  py::dict about() const;

  /// Throws InvalidInput, with all that is wrong with the robot's text.
  void check() const { static_cast<void>(catalogue()); }

  /// Calls each function on a few rows at the start, so that one that cannot be called is known before a folder is
  /// made. Throws what `call` does, and InvalidInput where a prior cannot simulate the start.
  void try_out(const scenario::Scenario& scenario) const;

  /// True if it has functions of Python, without which a run does not go on.
  bool has_functions() const { return !additions_.empty(); }

  const std::shared_ptr<Failure>& failure() const { return failure_; }

 private:
  experiment::Catalogue catalogue(const robot_file::Functions& functions) const;

  /// Adds a function of Python, whose exceptions go to `failure`.
  using Addition = std::function<void(robot_file::Functions& functions, const std::shared_ptr<Failure>& failure)>;
  void add(Addition addition);

  std::string text_, source_;
  std::filesystem::path folder_;
  std::vector<Addition> additions_;
  robot_file::Functions functions_;
  std::shared_ptr<Failure> failure_ = std::make_shared<Failure>();
};

void add_robot(py::module_& module);

}  // namespace rehearse::python
