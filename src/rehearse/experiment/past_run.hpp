#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::experiment {

/// A run as its folder has it. Use it to do something with what was learned; `resume_run` continues a run.
struct PastRun {
  Resolved resolved;
  History history;
  Catalogue catalogue;  // with its robot

  /// A trial that is done or asked for, or the one with the highest return if none is named. Throws InvalidInput if
  /// there is none.
  const TrialRecord& trial(std::optional<Index> number) const;

  /// Options for an evaluation: where the prior plays the robot, its parameters as the newest model has them, then
  /// `others`.
  std::vector<std::pair<std::string, std::string>> as_identified(
      const std::vector<std::pair<std::string, std::string>>& others = {}) const;
};

/// Reads a folder. It changes nothing and locks nothing, so the run may be going on. Throws InvalidInput if it is no
/// run folder.
PastRun read_run(const Catalogue& catalogue, const std::filesystem::path& folder);

/// The policy of which a trial's θ are the parameters. Throws InvalidInput if the scenario has none of that name.
std::shared_ptr<const policy::Policy> policy_of(const TrialRecord& trial, const scenario::Scenario& scenario);

}  // namespace rehearse::experiment
