#pragma once

#include <string>
#include <string_view>

#include "rehearse/campaign/plan.hpp"
#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::campaign {

/// Throws InvalidInput with a line for everything that is wrong. source: the file's name, for messages.
CampaignPlan plan_campaign(const experiment::Catalogue& catalogue, std::string_view text, const std::string& source);

}  // namespace rehearse::campaign
