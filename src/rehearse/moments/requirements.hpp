#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::moments {

/// The features of a state for models that have moments: those of policies, then, if wanted, the task's joint angles.
FeatureMap model_features(const Task& task, bool joint_angles);

/// A learner that needs moments, as messages name it.
struct User {
  std::string_view who, otherwise;  // what else to choose
  bool joint_angles = false;        // they are inputs of its model
};

/// The parts of a task or a policy without analytic moments, a line each.
std::vector<std::string> without_moments(const Task& task, const policy::Policy& policy, const User& user);

}  // namespace rehearse::moments
