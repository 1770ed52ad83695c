#pragma once
// Folders of runs and campaigns as one page (docs/report.md). Reads files alone; independent of algorithms and robots.

#include <filesystem>
#include <string>
#include <string_view>

#include "rehearse/report/page_data.hpp"

namespace rehearse::report {

/// Reads a run folder (docs/run-folder.md) or a campaign folder (docs/campaigns.md). A file that cannot be read is left
/// out and named among the problems. Throws InvalidInput if the folder is neither, or its spec.toml or summary.json is
/// unusable.
Report read_folder(const std::filesystem::path& folder, const Knowledge& knowledge = {});

/// Reads one trial of a run folder. headline: what stands over the page instead of learner and robot; empty: these.
/// Throws InvalidInput, too, if there is no such trial.
Report read_trial(const std::filesystem::path& folder, Index trial, const std::string& headline = "");

/// A self-contained page. page_template: the built page of web/, which has one place for the data. Throws InvalidInput
/// if it has not.
std::string to_html(const Report& report, std::string_view page_template);

}  // namespace rehearse::report
