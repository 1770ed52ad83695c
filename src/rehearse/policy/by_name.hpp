#pragma once

#include <memory>
#include <string>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// A trial's policy from its name, as records keep it: `own`, which is the scenario's, or a schedule, a hand-over from
/// `own` or a tracking policy for this task. parameters: the size of its θ. Throws InvalidInput for any other name.
std::shared_ptr<const Policy> by_name(const std::string& name, Index parameters, const Task& task,
                                      const std::shared_ptr<const Policy>& own);

}  // namespace rehearse::policy
