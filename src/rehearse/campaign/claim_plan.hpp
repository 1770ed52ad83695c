#pragma once

#include "rehearse/campaign/plan.hpp"

namespace rehearse::files {
class FileViolations;
}

namespace rehearse::campaign {

/// Finds the groups that a claim about learners of the plan means; what is wrong with it becomes violations.
PlannedClaim plan_claim(const CampaignPlan& plan, const Claim& claim, files::FileViolations& violations);

}  // namespace rehearse::campaign
