#include "rehearse/policy/description.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::policy {

Description describe(const Policy& policy, const ConstVectorView& theta) {
  const auto* describable = dynamic_cast<const Describable*>(&policy);
  if (!describable)
    throw InvalidInput(fmt::format("a policy of kind '{}' does not say what it is made of", policy.name()));
  if (theta.size() != policy.parameters() || !theta.allFinite())
    throw InvalidInput(
        fmt::format("theta has {} numbers, must have {} finite ones", theta.size(), policy.parameters()));
  return describable->describe(theta);
}

std::vector<Input> inputs_of(const FeatureMap& features, const Vector& scale) {
  using enum Input::Function;
  if (!features.joints().empty()) throw InvalidInput("policies see no angles between links");
  if (features.features() == 0) throw InvalidInput("the policy sees no state");
  std::vector<Input> inputs;
  const auto add = [&](Index state, Input::Function function) {
    inputs.push_back({state, function, scale(static_cast<Index>(inputs.size()))});
  };
  for (Index state = 0; state < features.states(); ++state) {
    const StateKind kind = features.kinds()[static_cast<std::size_t>(state)];
    if (kind == StateKind::plain) add(state, identity);
    if (kind == StateKind::angle) add(state, cosine), add(state, sine);
  }
  return inputs;
}

}  // namespace rehearse::policy
