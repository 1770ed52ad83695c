#include "rehearse/moments/requirements.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/moment_kernel.hpp"
#include "rehearse/reward/saturating.hpp"

namespace rehearse::moments {

FeatureMap model_features(const Task& task, bool joint_angles) {
  return joint_angles ? FeatureMap(task.feature_map().kinds(), task.model_features().joints()) : task.feature_map();
}

std::vector<std::string> without_moments(const Task& task, const policy::Policy& policy, const User& user) {
  const auto& [who, otherwise, joint_angles] = user;
  Violations violations;
  const bool chosen = policy.name() == "mlp" || policy.name() == "linear";  // by the option `policy`
  violations.require(analytic_options(policy).has_value(),
                     fmt::format("policy = {} has no analytic moments, which {} needs: choose {}{}", policy.name(), who,
                                 chosen ? "policy = rbf (--set policy=rbf), policy = linear with policy_squash = sine, "
                                          "or "
                                        : "",
                                 otherwise));
  violations.require(!task.cost,
                     fmt::format("the task has a cost of steps, whose moments are not known: choose {}", otherwise));
  violations.require(!task.episode_reward,
                     fmt::format("the task has a reward of whole episodes ([reward] episode), whose moments are not "
                                 "known: choose {}",
                                 otherwise));
  violations.require(task.limits.empty(),
                     fmt::format("the task has limits, which {} does not keep: choose {}", who, otherwise));
  violations.require(
      !task.actuators().changes_commands(),
      fmt::format("the task has max_rate or filter_s of an action, whose moments are not known: choose {}", otherwise));
  violations.require(reward::closed_form(task.reward) != nullptr,
                     fmt::format("the scenario's reward has no analytic moments, which {} needs: give it distances "
                                 "that are sums of multiples of states, and of sines and cosines of angles (in a "
                                 "robot's file [reward] distance = […] and width, or a formula exp(-(…)^2 - …); in C++ "
                                 "reward::saturating with a closed form), or choose {}",
                                 who, otherwise));
  const Index inputs = model_features(task, joint_angles).features() + task.action_size();
  violations.require(inputs <= kMostMomentInputs, fmt::format("{} features and actions, {} takes at most {}: choose {}",
                                                              inputs, who, kMostMomentInputs, otherwise));
  return violations.list();
}

}  // namespace rehearse::moments
