#pragma once
// The text of the files in a run folder. Numbers are written so that they read back exactly; what does not apply is
// empty. Nothing here touches a disk.

#include <string>
#include <vector>

#include "rehearse/core/expected_episode.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/learners/learner.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::experiment {

/// Names of the tunable parameters of a prior; empty without one.
std::vector<std::string> tunable_names(const std::optional<prior::Prior>& prior);

/// One row a trial. A parameter has three columns: its value and the ends of its interval. `evaluated`: the expected
/// return has one, since the scenario evaluates policies.
std::string trials_csv(const std::vector<TrialRecord>& trials, const std::vector<std::string>& phi_names,
                       bool evaluated = false);
std::string timings_csv(const std::vector<TrialRecord>& trials);

/// Forecast errors: one row per trial and horizon.
std::string errors_csv(const std::vector<TrialRecord>& trials, const Task& task);

/// Identifiability warnings of the trials before, one row each.
std::string identifiability_csv(const std::vector<TrialRecord>& trials);

/// Limits of the task: one row per trial and limit.
std::string limits_csv(const std::vector<TrialRecord>& trials);

/// Failures that were survived, one row each.
std::string notes_csv(const std::vector<TrialRecord>& trials);

/// Episodes of other controllers, one row each.
std::string logs_csv(const std::vector<Log>& logs, const Task& task);

/// The best observed policy and each trial's.
std::string policies_json(const std::vector<TrialRecord>& trials, const Resolved& resolved);

/// A learner's table as CSV.
std::string learners_csv(const learners::Table& table);

std::string trajectory_csv(const Task& task, const Episode& episode);

/// Mean and quantiles of every state by step. `moments`: the same episode by moment matching; unless null it stands
/// beside what it is to be compared with.
std::string prediction_csv(const Task& task, const rollout::Recorded& recorded,
                           const ExpectedEpisode* moments = nullptr);

}  // namespace rehearse::experiment
