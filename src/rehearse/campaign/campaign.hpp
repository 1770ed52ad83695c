#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rehearse/campaign/options.hpp"
#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::campaign {

/// Does what is left to do of the campaign in a folder, which is made if it is not there. A run that fails is recorded
/// and does not stop the others. text: the campaign file's; source: its name, for messages. Throws InvalidInput before
/// anything runs; std::runtime_error if the tables cannot be written. After a stop, some runs are unfinished. The
/// result of a share has only its own runs, which cannot be judged. With ranks, rank 0 hands out the runs, writes the
/// tables and has the listener; on the others the result has no runs.
Campaign run_campaign(const experiment::Catalogue& catalogue, std::string_view text, const std::string& source,
                      const std::filesystem::path& folder, const CampaignOptions& options);

}  // namespace rehearse::campaign
