#pragma once
// Campaign files for the line and what becomes of them.

#include <string>

#include "rehearse/campaign/planner.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/test/fake.hpp"

namespace rehearse::campaign::plans {

inline const std::string kHead = "format = 1\nscenario = \"line\"\nseeds = [4, 2]\ntrials = 3\n";

inline CampaignPlan plan_of(const std::string& rest) {
  return plan_campaign(experiment::fake::catalogue(), kHead + rest, "c.toml");
}

inline std::string complaint(const std::string& text) {
  return experiment::fake::message_of<InvalidInput>(
      [&] { plan_campaign(experiment::fake::catalogue(), text, "c.toml"); });
}

}  // namespace rehearse::campaign::plans
