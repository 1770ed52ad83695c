#pragma once
// The campaign file as it was written; docs/campaigns.md describes it.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::files {
class FileViolations;
}

namespace rehearse::campaign {

/// An option of which the grid has several values.
struct Axis {
  std::string key;
  std::vector<std::string> texts;
  Index line = 0;
};

/// Options that go together, under a name.
struct Variant {
  std::string name;
  std::string preset;  // empty: none
  std::vector<experiment::FileOption> options;
  Index line = 0;
};

/// An option whose value is drawn for each seed, uniformly.
struct Draw {
  std::string key;
  double low = 0, high = 0;
  Index line = 0;
};

enum class Metric { total_reward, best_return, first_success };

/// A measure of a run: a metric, of this trial or of the trials until this one, as the metric says.
struct Measure {
  Metric metric = Metric::total_reward;
  Index trial = 0;
  std::optional<double> success_return;  // success is this return; empty: it is what the scenario calls solved
};

/// Bounds of how many of the runs succeed; those that are given.
struct SuccessClaim {
  Measure measure{Metric::first_success, 0, {}};
  std::optional<double> at_least_rate, at_most_rate;
  std::optional<Index> at_least_runs, at_most_runs;
};

/// The claim's runs are better than others, which differ from them in what is named here, or not worse by a margin.
struct ComparisonClaim {
  Measure measure;
  std::optional<std::string> learner, prior, variant;
  std::optional<double> not_worse_by;  // empty: better
};

struct MedianClaim {
  Measure measure;
  std::optional<double> at_least, at_most;
};

struct Claim {
  std::string text;
  Index line = 0;
  std::string learner;
  std::vector<std::string> priors, variants;  // empty: all
  bool pooled = false;
  bool observed = false;
  std::optional<SuccessClaim> success;  // of these three, one
  std::optional<ComparisonClaim> comparison;
  std::optional<MedianClaim> median;
};

struct CampaignFile {
  std::string title, scenario;
  std::string preset;  // empty: none
  std::vector<std::string> learners, priors;
  std::vector<Index> seeds;
  Index trials = 10;
  bool until_solved = false;
  std::vector<experiment::FileOption> options;
  std::map<std::string, std::vector<experiment::FileOption>> learner_options;
  std::vector<Axis> axes;
  std::vector<Variant> variants;
  std::vector<Draw> draws;
  std::vector<Claim> claims;
  std::map<std::string, Index> lines;  // of the keys outside tables, and "learner.NAME"
};

/// Reads as much as can be understood; what cannot becomes violations. Throws InvalidInput if it is no TOML.
CampaignFile read_campaign_file(std::string_view text, const std::string& source, files::FileViolations& violations);

}  // namespace rehearse::campaign
