#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/scenario/drawing.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::scenario {

/// The plant's own dynamics, among the names of priors.
inline constexpr const char* kOracle = "oracle";

/// A simulator with the values its parameters start from and which of them may be tuned.
struct NamedPrior {
  std::string name;
  std::shared_ptr<const system::Simulator> simulator;
  ParameterSpace parameters;  // the simulator's, with this prior's values
  // The same, but joints whose targets are the actions move there evenly and are there when the step ends: it predicts
  // the rest of the robot, where GPs learn the joints' positions. Null: there is none.
  std::shared_ptr<const system::Simulator> driven = nullptr;
  std::vector<std::string> lacks = {};  // parts of what it simulates that the task's states leave out, a line each
};

/// Whether the plant, which may be a real robot, is about to move. Programs of a plant that is left alone do not start.
enum class PlantUse { driven, left_alone };

/// A task, a plant to do it on, guesses of the plant, and the policy to learn.
struct Scenario {
  std::string name;
  Task task;
  std::function<std::unique_ptr<system::Plant>()> make_plant;  // null: a robot that Rehearse does not drive
  std::vector<NamedPrior> priors;                              // the first is the default
  std::shared_ptr<const system::Simulator> oracle;  // the plant's own dynamics, for `--prior oracle`; may be null
  std::vector<std::string> oracle_lacks;            // properties of the plant that its oracle lacks, a line each
  std::shared_ptr<const policy::Policy> policy;     // to learn; not null
  std::optional<Drawing> drawing;                   // empty: it cannot be shown
  // Throws InvalidInput with why a prior cannot be used, or the plant where it is driven; a plant that is left alone is
  // not even asked. Null: they can.
  std::function<void(PlantUse)> require_ready;
  std::function<void()> require_oracle;  // throws InvalidInput with why the oracle cannot be used; null: it can
  std::function<std::vector<std::string>()> faults;  // of programs so far, a sentence each; null: there are none
  std::function<Index()> lost_rows;  // rows so far that programs may answer another time, but did not; null: none
  Vector stand_in_noise;  // standard deviations (dx) of what is measured where a prior plays the robot; empty: 0
  Index evaluations = 0;  // extra episodes of each trial's policy on a plant of their own, which are no
                          // interaction: their mean return is recorded as expected_return; 0: none
};

/// The functions of a scenario in words, for people.
struct Details {
  std::vector<std::string> reward;  // lines
  std::string ended;                // the condition
  std::vector<std::string> plant;   // lines: dynamics, values, noise
  std::vector<std::string> priors;  // one a prior: its dynamics
};

/// A file that a robot's file names, by its path from there.
struct NamedFile {
  std::string path, bytes;
};

/// The bytes of a file by its path from the robot's file; empty: there is none.
using ReadFile = std::function<std::optional<std::string>(const std::string& path)>;

/// A scenario whose options can still be set: what a robot's folder gives to the catalogue.
class ScenarioBuilder {
 public:
  virtual ~ScenarioBuilder() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;  // one line for `rehearse list`
  virtual std::vector<std::string> prior_names() const = 0;
  virtual void fields(FieldVisitor& v) = 0;                       // plant.NAME, noise, …
  virtual Scenario build() const = 0;                             // throws InvalidInput
  virtual std::vector<std::string> stated() const { return {}; }  // options of the policy that the robot's file sets
  virtual std::vector<NamedFile> files() const { return {}; }     // what it is made of beside the robot's file
  virtual Details details() const { return {}; }                  // parts may be empty
};

/// Each call makes a new one, since its options can be set.
using MakeBuilder = std::function<std::unique_ptr<ScenarioBuilder>()>;

}  // namespace rehearse::scenario
