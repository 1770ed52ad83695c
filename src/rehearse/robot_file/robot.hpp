#pragma once
// A robot as a file describes it, before anything is made of it.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "rehearse/core/actuators.hpp"
#include "rehearse/core/parameters.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/mujoco/description.hpp"
#include "rehearse/robot_file/functions.hpp"
#include "rehearse/scenario/ode_scenario.hpp"
#include "rehearse/system/formula_ode.hpp"

namespace rehearse::robot_file {

/// A formula and where it stands; or "@NAME", a function of the program (functions.hpp).
struct Formula {
  std::string text;
  Index line = 0;

  bool empty() const { return text.empty(); }
  bool is_function() const { return text.starts_with('@'); }
  std::string function() const { return text.substr(1); }
};
using Definitions = std::vector<std::pair<std::string, Formula>>;  // in the order of the file

struct State {
  StateVariable variable;
  double start = 0, start_noise = 0;
  double scale = 1;  // what the policy's input is divided by
};

/// Rewards between 0 and 1 that are high near a goal, or any formula.
struct RewardFormulas {
  std::vector<Formula> distance;  // all 0 at the goal
  double width = 1;               // of all of them together
  Formula formula;                // instead of a distance
  double floor = 0;
  Formula cost;     // of states, actions, actions before (NAME_before) and time; is subtracted
  Formula episode;  // of a whole episode (episode_formula.hpp); is added to the return
};

/// A condition that has to hold for the last seconds of an episode.
struct Success {
  Formula when;
  double last_s = 0;
};

/// A condition that every step must keep, of what a cost may use.
struct LimitFormula {
  std::string name;
  Formula keep;
  double risk = 0.05;  // the largest probability that an episode does not
};

/// dx/dt as formulas of states, actions and parameters.
struct Equations {
  Definitions definitions;
  std::vector<Formula> rates;  // one a state
};

/// A program as the source (system/program_simulator.hpp).
struct ProgramSource {
  std::vector<std::string> command;
  double start_s = 30, answer_s = 10;
};

/// A model of MuJoCo. Path, control step and values of parameters come later.
using ModelSource = mujoco::ModelDescription;

/// A function of the program.
struct FunctionSource {
  std::string name;
};

/// The changes of states, and their source.
struct Dynamics {
  std::string name;
  Index line = 0;
  std::vector<Parameter> parameters;  // all fixed, at their usual values
  std::variant<Equations, ProgramSource, ModelSource, FunctionSource> source;
  std::map<std::string, Index> lines;  // that violations of a model are about, by their beginnings
  mujoco::SharedModel model;           // compiled by `compile_models`; null: it is none
  mujoco::Warnings warnings;           // of a model
};

/// Dynamics with values of their own, and which of them may be tuned.
struct Variant {
  std::string name;
  std::string dynamics;
  ParameterSpace parameters;
};

struct Body {
  std::string name;
  Formula from[2], to[2];
  double width_m = 0.05;
};

struct Robot {
  std::string name, summary;
  double dt_s = 0;
  Index horizon = 0;
  std::vector<State> states;
  std::vector<ActionVariable> actions;
  Definitions definitions;
  RewardFormulas reward;
  Success success;
  Formula ended;
  std::vector<LimitFormula> limits;
  std::vector<Dynamics> dynamics;
  std::vector<Actuation> plant_actuation;  // the plant's own actuators, one an action
  bool has_plant = false;                  // false: a real one, whose episodes come by `tell`
  std::string plant_function;              // plays the robot instead of `plant`; empty: none does
  Variant plant;
  std::vector<Variant> priors;  // the first is the default
  scenario::OdeOptions options;
  std::vector<std::string> stated;  // options of the policy that the file sets
  std::vector<Body> bodies;
  std::vector<scenario::NamedFile> files;  // of programs and models
  Functions functions;

  bool has_plant_dynamics() const { return has_plant && plant_function.empty(); }  // `plant` plays the robot
  std::vector<std::string> state_names() const;
  std::vector<std::string> task_state_names() const;  // and of what actuators remember
  Actuators actuators() const { return {actions, dt_s, static_cast<Index>(states.size())}; }
  Actuators plant_actuators() const;
  std::vector<std::string> action_names() const;
  const Dynamics& dynamics_of(const Variant& variant) const;
  system::OdeFormulas equation(const Dynamics& dynamics) const;  // whose source are Equations
};

}  // namespace rehearse::robot_file
