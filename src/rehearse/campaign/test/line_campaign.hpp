#pragma once
// Whole campaigns of pretending learners on the line.

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "rehearse/campaign/campaign.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/test/fake.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::campaign::line {

namespace fs = std::filesystem;

inline const std::string kThreeLearners =
    "format = 1\nscenario = \"line\"\nlearners = [\"echo\", \"echo-alone\", \"pilco\"]\n";
inline const std::string kGrid = kThreeLearners + "priors = [\"near\", \"far\"]\nseeds = \"1-2\"\ntrials = 2\n";
inline const std::string kClaim =
    "[[claim]]\ntext = \"it works\"\nlearner = \"echo\"\nsolved_by = 2\nat_least_runs = 1\n";

inline Campaign run(const fs::path& folder, const std::string& text = kGrid,
                    const CampaignOptions& options = {.threads = 1}) {
  return run_campaign(experiment::fake::catalogue(), text, "c.toml", folder, options);
}

inline std::string refusal(const fs::path& folder, const std::string& text) {
  return experiment::fake::message_of<InvalidInput>([&] { run(folder, text); });
}

inline nlohmann::json summary_of(const fs::path& folder) {
  return nlohmann::json::parse(files::read_file(folder / "summary.json"));
}

/// Bytes that must not depend on how the campaign came about.
inline std::string results_of(const fs::path& folder) {
  return files::read_file(folder / "campaign.csv") + files::read_file(folder / "summary.json");
}

}  // namespace rehearse::campaign::line
