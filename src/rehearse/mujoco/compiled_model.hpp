#pragma once
// For the files of this room.

#include <string>
#include <vector>

#include "rehearse/core/parameters.hpp"
#include "rehearse/mujoco/engine.hpp"
#include "rehearse/mujoco/parameters.hpp"
#include "rehearse/mujoco/states.hpp"

namespace rehearse::mujoco {

class CompiledModel {
 public:
  /// Throws InvalidInput, all violations at once.
  explicit CompiledModel(const ModelDescription& description);

  mjModel& original() const { return *original_; }
  const std::string& file() const { return file_; }  // its name, for messages
  int keyframe() const { return keyframe_; }         // −1: none
  Index substeps() const { return substeps_; }
  const States& states() const { return states_; }
  const Parameters& parameters() const { return parameters_; }
  Index actions() const { return static_cast<Index>(actions_.size()); }

  /// Puts u (du) where it acts.
  void act(const Vector& u, mjData& data) const;

  /// Positions, velocities and activations that no state gives, a line each.
  std::vector<std::string> unseen() const;

  /// The actions that are bounded (du) beyond what their actuators take, and the joints that `start` has outside of
  /// their ranges, a line each.
  std::vector<std::string> misfits(const std::vector<Interval>& bounds, const mjData& start) const;

  const std::vector<std::string>& parameter_names() const { return parameter_names_; }
  Vector start_values() const { return start_values_; }  // of the parameters

 private:
  struct Target {
    Action::Kind kind;
    int address;  // in ctrl or in qfrc_applied
  };

  void read_time(const ModelDescription& description, Violations& violations);
  void find_actions(const std::vector<Action>& actions, Violations& violations);

  std::string file_;
  ModelPointer original_;
  int keyframe_ = -1;
  Index substeps_ = 0;
  States states_;
  Parameters parameters_;
  std::vector<Target> actions_;
  std::vector<std::string> parameter_names_;
  Vector start_values_;
};

}  // namespace rehearse::mujoco
