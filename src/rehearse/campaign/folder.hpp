#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/campaign/results.hpp"
#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::campaign {

/// The folder of a campaign, locked while this lives: by one process for all of it, or by several for a share each.
class CampaignFolder {
 public:
  /// A new folder, an empty one, or that of this campaign or of a part of it. text: the campaign file's, of which
  /// `plan` was made. kind: shared by processes that do a share of the runs each. Throws InvalidInput if the folder is
  /// anything else, asks for other runs, cannot be written, or is in use.
  static CampaignFolder open(const experiment::Catalogue& catalogue, const std::filesystem::path& path,
                             std::string_view text, const CampaignPlan& plan,
                             files::FolderLock::Kind kind = files::FolderLock::Kind::exclusive);

  /// A folder that another rank has opened and locked for this one. Throws InvalidInput if this machine does not see
  /// it.
  static CampaignFolder join(const std::filesystem::path& path, std::string_view text);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path path_of(const PlannedRun& run) const { return path_ / "runs" / run.name; }

  /// The state of a run's folder: done, unfinished (or not there), or failed when it is another's or unreadable.
  RunOutcome read(const PlannedRun& run) const;

  /// Removes what runs of the plan left behind that were killed while their folders were made. Only where no other
  /// process is at work in the folder: it would lose what it is making.
  void remove_abandoned(const CampaignPlan& plan) const;

  /// Folders under runs/ that are none of the plan's, in order of name.
  std::vector<Skipped> strangers(const CampaignPlan& plan) const;

  /// campaign.csv and summary.json, each in one step.
  void write(const Campaign& campaign) const;

 private:
  CampaignFolder(std::filesystem::path path, std::optional<files::FolderLock> lock)
      : path_(std::move(path)), lock_(std::move(lock)) {}

  std::filesystem::path path_;
  std::optional<files::FolderLock> lock_;
};

}  // namespace rehearse::campaign
