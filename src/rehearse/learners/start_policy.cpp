#include "rehearse/learners/start_policy.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::learners {

void require_start_in_box(const Setting& setting, double box, const std::string& option) {
  if (!setting.start || !setting.policy) return;
  const bool own = setting.policy->box().has_value();
  const Interval bounds = setting.policy->box().value_or(Interval{-box, box});
  const Vector& start = *setting.start;
  for (Index i = 0; i < start.size(); ++i)
    if (!(start(i) >= bounds.low && start(i) <= bounds.high))
      throw InvalidInput(
          fmt::format("{}: parameter {} of the policy to begin with is {}, policies are searched in {} to {}{}",
                      own ? "policy" : option, i + 1, start(i), bounds.low, bounds.high,
                      own ? "" : fmt::format(": set {} to {} or more", option, start.cwiseAbs().maxCoeff())));
}

}  // namespace rehearse::learners
