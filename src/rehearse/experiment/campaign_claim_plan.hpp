#pragma once

#include "rehearse/experiment/campaign_plan.hpp"

namespace rehearse::experiment {

class FileViolations;

/// Finds the groups that a claim about learners of the plan means; what is wrong with it becomes violations.
PlannedClaim plan_claim(const CampaignPlan& plan, const Claim& claim, FileViolations& violations);

}  // namespace rehearse::experiment
