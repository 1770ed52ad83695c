#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "rehearse/moments/policy_moments.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"

namespace rehearse::moments {

/// The options of a policy whose actions have analytic moments: one of radial basis functions, or a linear one
/// with a sine as squash. Empty for any other. The options live as long as the policy.
using AnalyticOptions = std::variant<const policy::RbfOptions*, const policy::LinearOptions*>;
std::optional<AnalyticOptions> analytic_options(const policy::Policy& policy);

/// θ ↦ the moments of a policy at θ; throws InvalidInput if it has another size. Empty if the policy has none.
using PolicyMomentsAt = std::function<std::unique_ptr<PolicyMoments>(const ConstVectorView& theta)>;
PolicyMomentsAt policy_moments(const policy::Policy& policy);

}  // namespace rehearse::moments
