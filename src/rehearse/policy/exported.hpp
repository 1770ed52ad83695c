#pragma once
// A policy to take along: as C, as JSON, and as a Python module, all from one description.

#include <optional>
#include <string>
#include <string_view>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/description.hpp"

namespace rehearse::policy {

/// The origin of a policy.
struct Origin {
  std::string robot, learner;
  std::string prior;  // empty: none
  Index seed = 1, trial = 1;
  std::optional<double> total_reward;  // of that trial; empty: it is to come
};

/// The original's actions in some states, for tests of the exported policy.
struct Answers {
  Matrix states;   // n × dx
  Vector times_s;  // n
  Matrix actions;  // n × du: commands
};

/// The contents of all three texts. A value.
struct Exported {
  Origin origin;
  std::vector<StateVariable> states;
  std::vector<ActionVariable> actions;  // with their bounds
  Actuators actuators;                  // turn actions into commands; the last states are their memory
  double dt_s = 0;
  Index horizon = 0;  // control steps of a trial
  std::string kind;   // the policy's name: "mlp"
  Vector theta;
  Description description;
  Answers answers;
};

/// states: n × dx, which the policy is asked about at `times_s` (n). Throws InvalidInput as `describe` does, and where
/// they are of other sizes.
Exported make_exported(const Origin& origin, const Task& task, const Policy& policy, const Vector& theta,
                       const Answers& asked);

/// The same at another θ. policy: that of `exported`. Throws InvalidInput as `describe` does.
Exported with_theta(Exported exported, const Policy& policy, const Vector& theta);

/// The three texts below carry the memory of actuators, if there is any, from step to step, and answer with commands.
/// They answer a state or a time that is not finite with NaN for every action.
///
/// C99, and C++: a header with a function NAME_act, which needs <math.h> alone and allocates nothing. name: a word for
/// identifiers (`identifier` makes one); functions are static, so policies of two names live in one program.
std::string to_c(const Exported& exported, const std::string& name);

/// All of `Exported`. docs/export.md has the fields.
std::string to_json(const Exported& exported);

/// A Python module with a function act(states, t), on NumPy.
std::string to_numpy(const Exported& exported);

/// Among the first characters of every text.
inline constexpr const char* kExportedMark = "policy that was learned on a robot, written by Rehearse";

/// True if a text is one of these.
bool is_exported(std::string_view text);

/// The text with everything replaced that no identifier may have; "policy_" before a digit.
std::string identifier(const std::string& text);

}  // namespace rehearse::policy
