#include "rehearse/policy/by_name.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/hand_over.hpp"
#include "rehearse/policy/schedule.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::policy {

std::shared_ptr<const Policy> by_name(const std::string& name, Index parameters, const Task& task,
                                      const std::shared_ptr<const Policy>& own) {
  if (name == own->name()) return own;
  if (name == kSchedule) return make_schedule(task);
  if (name == kHandOver) return make_hand_over(task, own);
  if (name == kTracking) return make_tracking(task, parameters / numbers_of_stage(task));
  throw InvalidInput(fmt::format("the policy '{}' is neither the scenario's, '{}', nor '{}', '{}' or '{}'", name,
                                 own->name(), kSchedule, kTracking, kHandOver));
}

}  // namespace rehearse::policy
