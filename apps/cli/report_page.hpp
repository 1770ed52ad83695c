#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/report/page_data.hpp"

namespace rehearse::apps {

struct Page {
  std::string html;
  std::vector<report::Problem> problems;  // parts of the folder that could not be used
};

/// Throws InvalidInput if the page without data is not built, so that nobody learns of it after the work.
void require_page_template(const std::string& share);

/// The page of a run or of a campaign. built_in: the robots whose task the page describes. share: the folder of the
/// page without data, where it is not beside the program. Throws InvalidInput.
Page report_page(const experiment::Catalogue& built_in, const std::filesystem::path& folder, const std::string& share);

/// The page of one trial. headline: instead of learner and robot.
Page replay_page(const std::filesystem::path& folder, Index trial, const std::string& share,
                 const std::string& headline = "");

}  // namespace rehearse::apps
