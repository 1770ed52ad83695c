#pragma once

#include <memory>

#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::scenario {

/// Which policy a scenario learns, as options of the scenario.
struct PolicyOptions {
  enum class Kind { mlp, rbf, linear };
  Kind policy = Kind::mlp;
  Index hidden = 10;       // units of the mlp
  double policy_gain = 1;  // of mlp and linear, whose output is u_max tanh(gain · a)
  Index centres = 10;      // of the rbf
  void fields(FieldVisitor& v);
};

/// Its inputs are the task's features divided by `scale`, its actions inside the task's bounds. Throws InvalidInput.
std::shared_ptr<const policy::Policy> make_policy(const PolicyOptions& options, const Task& task, const Vector& scale);

}  // namespace rehearse::scenario
