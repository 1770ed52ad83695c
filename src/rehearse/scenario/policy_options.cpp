#include "rehearse/scenario/policy_options.hpp"

#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"

namespace rehearse::scenario {

void PolicyOptions::fields(FieldVisitor& v) {
  v.choice("policy", policy, "network, radial basis functions, or linear", {"mlp", "rbf", "linear"});
  v.integer("hidden", hidden, "hidden units of the network", between(1, 1e4));
  v.number("policy_gain", policy_gain, "gain before the squashing function (mlp, linear)", above(0));
  v.choice("policy_squash", policy_squash, "squashing function of mlp and linear policies", {"tanh", "sine"});
  v.integer("centres", centres, "radial basis functions", between(1, 1e4));
}

std::shared_ptr<const policy::Policy> make_policy(const PolicyOptions& options, const Task& task, const Vector& scale) {
  const std::vector<Interval> bounds = task.action_bounds();
  const policy::Squash squash{bounds, options.policy_gain, options.policy_squash};
  switch (options.policy) {
    case PolicyOptions::Kind::rbf:
      return policy::make_rbf(
          {.features = task.feature_map(), .scale = scale, .centres = options.centres, .bounds = bounds});
    case PolicyOptions::Kind::linear:
      return policy::make_linear({.features = task.feature_map(), .scale = scale, .squash = squash});
    default:
      return policy::make_mlp(
          {.features = task.feature_map(), .scale = scale, .hidden = options.hidden, .squash = squash});
  }
}

}  // namespace rehearse::scenario
