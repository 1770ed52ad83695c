#pragma once
// Options that a campaign file decides in more than one place. For the sources of this room.

#include <string>
#include <utility>
#include <vector>

#include "rehearse/campaign/file.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::campaign {

/// The names in a complete spec of what `--set key=…` reaches in its run: none, one, or prior.NAME of several priors.
std::vector<std::string> reached_options(const experiment::Spec& complete, const std::string& key);

/// Line and message for every option that runs of this spec would get from two of [draw], [vary] and the variants, or
/// from [draw] and [set] or [learner.NAME], by whatever names: only one would count, and runs under two labels be the
/// same.
std::vector<std::pair<Index, std::string>> overlaps(const experiment::Spec& complete, const CampaignFile& file);

}  // namespace rehearse::campaign
