#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rehearse/campaign/file.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::campaign {

/// The runs that differ in their seeds alone.
struct CampaignGroup {
  std::string learner;
  std::string prior;                                         // empty: the learner takes none
  std::string variant;                                       // "NAME,key=value,…"; empty: nothing varies
  std::vector<std::pair<std::string, std::string>> options;  // the varied ones
};

struct PlannedRun {
  std::string name;  // of its folder
  std::size_t group = 0;
  experiment::Spec spec;  // complete
};

/// Groups whose runs are judged together. In a comparison, groups[i] is compared with against[i].
struct ClaimPart {
  std::vector<std::size_t> groups, against;
};

struct PlannedClaim {
  Claim claim;
  std::vector<ClaimPart> parts;
  std::string missing;  // why it cannot be judged: a learner is missing
};

struct MissingLearner {
  std::string name, reason;
};

/// Everything that a campaign is going to do. Runs stand in the order of the file, those of a group together.
struct CampaignPlan {
  std::string title, scenario;
  Index trials = 0;           // a run
  bool until_solved = false;  // or before
  std::vector<Index> seeds;
  std::vector<CampaignGroup> groups;
  std::vector<PlannedRun> runs;
  std::vector<MissingLearner> missing;
  std::vector<PlannedClaim> claims;

  /// Where a run stands in `runs`, unless they are those of a share.
  std::size_t index_of(std::size_t group, std::size_t seed) const { return group * seeds.size() + seed; }
  const PlannedRun& run(std::size_t group, std::size_t seed) const { return runs[index_of(group, seed)]; }
};

}  // namespace rehearse::campaign
