#include "rehearse/moments/analytic_policy.hpp"

#include "rehearse/moments/linear_policy.hpp"
#include "rehearse/moments/rbf_policy.hpp"

namespace rehearse::moments {
namespace {

PolicyMomentsAt moments_of(const policy::RbfOptions& options) {
  return [options](const ConstVectorView& theta) { return std::make_unique<RbfPolicy>(options, theta); };
}
PolicyMomentsAt moments_of(const policy::LinearOptions& options) {
  return [options](const ConstVectorView& theta) { return std::make_unique<LinearPolicy>(options, theta); };
}

}  // namespace

std::optional<AnalyticOptions> analytic_options(const policy::Policy& policy) {
  if (const auto* rbf = dynamic_cast<const policy::Rbf*>(&policy)) return &rbf->options();
  const auto* linear = dynamic_cast<const policy::Linear*>(&policy);
  if (linear && linear->options().squash.shape == policy::Squash::Shape::sine) return &linear->options();
  return {};
}

PolicyMomentsAt policy_moments(const policy::Policy& policy) {
  const auto options = analytic_options(policy);
  if (!options) return {};
  return std::visit([](const auto* of_policy) { return moments_of(*of_policy); }, *options);
}

}  // namespace rehearse::moments
