#include "rehearse/moments/requirements.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/moments/moment_kernel.hpp"

namespace rehearse::moments {

FeatureMap model_features(const Task& task, bool joint_angles) {
  return joint_angles ? FeatureMap(task.feature_map().kinds(), task.model_features().joints()) : task.feature_map();
}

std::vector<std::string> without_moments(const Task& task, const policy::Policy& policy, const Need& need) {
  const auto& [who, otherwise, joint_angles] = need;
  Violations violations;
  violations.require(policy.analytic().has_value(),
                     fmt::format("policy = {} has no analytic moments, which {} needs: choose policy = rbf "
                                 "(--set policy=rbf), policy = linear with policy_squash = sine, or {}",
                                 policy.name(), who, otherwise));
  violations.require(task.saturating_reward.has_value(),
                     fmt::format("the scenario's reward has no analytic moments, which {} needs: give the task a "
                                 "saturating_reward, or choose {}",
                                 who, otherwise));
  const Index inputs = model_features(task, joint_angles).features() + task.action_size();
  violations.require(inputs <= kMostMomentInputs, fmt::format("{} features and actions, {} takes at most {}: choose {}",
                                                              inputs, who, kMostMomentInputs, otherwise));
  return violations.list();
}

}  // namespace rehearse::moments
