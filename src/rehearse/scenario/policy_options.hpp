#pragma once

#include <memory>

#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/policy/squash.hpp"

namespace rehearse::scenario {

/// The policy that a scenario learns, as options of the scenario.
struct PolicyOptions {
  enum class Kind { mlp, rbf, linear };
  Kind policy = Kind::mlp;
  Index hidden = 10;  // units of the mlp
  // Gain and squash are of mlp and linear, whose output is u_max squash(gain · a); the rbf's squash is a sine.
  double policy_gain = 1;
  policy::Squash::Shape policy_squash = policy::Squash::Shape::tanh;
  Index centres = 10;  // of the rbf
  void fields(FieldVisitor& v);
};

/// Its inputs are the task's features divided by `scale`, its actions inside the task's bounds. Throws InvalidInput.
std::shared_ptr<const policy::Policy> make_policy(const PolicyOptions& options, const Task& task, const Vector& scale);

}  // namespace rehearse::scenario
