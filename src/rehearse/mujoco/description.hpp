#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::mujoco {

/// A number of the model times a factor.
struct Term {
  std::string element;  // joint, sensor, body or site
  double factor = 1;
  Index component = 0;  // of a sensor's numbers, or of a place: 0, 1, 2 are x, y, z
};

/// A state is offset + Σ factor · number. The angle of a second link, measured as the first's is, is {"hip"} +
/// {"knee"}.
struct State {
  enum class Kind {
    position,  // of hinges [rad] and slides [m]; can be set
    velocity,  // of hinges [rad/s] and slides [m/s]; can be set
    sensor,    // readings of sensors; read only
    body,      // positions of the bodies' origins in the world [m]; read only
    site,      // positions of sites in the world [m]; read only
  };
  std::string name;  // for messages
  Kind kind = Kind::position;
  std::vector<Term> terms;
  double offset = 0;
};

/// The number of the model that an action sets.
struct Action {
  enum class Kind {
    actuator,  // the actuator's control
    joint,     // force or torque on a hinge or slide: for models without actuators, such as URDF
  };
  std::string element;
  Kind kind = Kind::actuator;
};

/// Numbers of the model that a parameter p moves. `value`: each becomes factor · p^power. `scale`: each is multiplied
/// by that. All values are set first, then scales multiply in the order of parameters. A link's mass m and length l, in
/// the file 2 kg and 0.5 m, scale its inertia by {.factor = 1 / 2.} for m and {.factor = 1 / 0.25, .power = 2} for l.
struct Target {
  enum class Apply { value, scale };
  std::string kind;      // "body", "joint", "geom", "actuator", "tendon" or "option"; field_names() has all fields
  std::string element;   // its name; of an option empty
  std::string field;     // "mass"
  Index component = -1;  // of a field of several numbers; −1: all
  Apply apply = Apply::value;
  double factor = 1, power = 1;
};

struct ModelParameter {
  std::string name, unit;
  double value = 0;  // where it starts
  std::vector<Target> targets;
};

/// A MuJoCo model as a robot. States and actions are those of the task, in its order. Positions and velocities of
/// joints that no state gives begin every step of a simulator where the keyframe has them: `warnings_of` lists them.
/// MuJoCo cuts actions to the ranges of their actuators. From a URDF it keeps collision shapes alone, joins links whose
/// joint is fixed, and looks for meshes beside the file, whatever folder they are said to be in.
struct ModelDescription {
  std::string path;      // MJCF or URDF; files that it names are looked for beside it
  std::string keyframe;  // empty: the model's reference position, at rest
  double dt_s = 0;       // control step, a whole number of the model's timesteps
  Index substeps = 0;    // timesteps of a control step, whatever the model says; 0: as the model says
  std::vector<State> states;
  std::vector<Action> actions;
  std::vector<ModelParameter> parameters;
};

/// A description that was checked against its model. It never changes. Any thread.
class CompiledModel;
using SharedModel = std::shared_ptr<const CompiledModel>;

/// Use it once for all simulators, plants and drawings of a model: to read meshes takes seconds, and the files are no
/// longer needed then. Throws InvalidInput, all violations at once, where the file or the description is wrong.
SharedModel compile(const ModelDescription& description);

/// Timesteps of the engine in a control step.
Index timesteps(const SharedModel& model);

/// Warnings to the user of a model and a task, a line each.
struct Warnings {
  std::vector<std::string> unseen;   // what a step depends on that no state gives: "velocity of joint 'knee'"
  std::vector<std::string> misfits;  // actions bounded beyond what actuators take, joints that start out of their range
};

/// The fields that a target of this kind may name, sorted; none: there is no such kind.
std::vector<std::string> field_names(const std::string& kind);

}  // namespace rehearse::mujoco
