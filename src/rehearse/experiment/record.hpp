#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::experiment {

/// The error of a model's mean prediction, continued over `horizon` steps from every state of an episode under the
/// actions that were taken, against the measured states.
struct ForecastError {
  Index horizon = 0;   // steps
  Index compared = 0;  // pairs of states
  Index failed = 0;    // pairs left out because the prediction was not finite
  Vector rms;          // dx, root mean square over the pairs; NaN if there are none
};

/// A limit of the task in one trial.
struct LimitRecord {
  std::string limit;
  double allowed = 0;               // the largest probability that an episode breaks it
  std::optional<double> predicted;  // fraction of the simulated episodes that broke it; none: none were simulated
  Interval interval{0, 1};          // 95 % of the probability that it estimates
  bool broken = false;              // by the trial's last step

  bool safe() const { return interval.high <= allowed; }
};

/// The record of one trial beside its episode. A value that does not apply is empty.
struct TrialRecord {
  Index trial = 0;
  double interaction_s = 0;               // on the plant, up to the end of this trial
  double total_reward = 0;                // trials.csv calls it `return`
  std::optional<double> expected_return;  // over extra episodes of the policy that are no interaction
  std::optional<bool> solved;
  bool cut_short = false;  // by no fault of the policy: the return does not compare with others, success is not known
  std::optional<double> predicted_return;
  std::vector<LimitRecord> limits;  // one a limit of the task
  Index rollouts = 0;
  Index failed_rollouts = 0;
  std::optional<double> log_evidence;
  std::vector<double> phi;                             // of the tunable parameters
  std::vector<std::optional<Interval>> phi_intervals;  // 95 %, as phi; none: of a discrete or a given value
  std::vector<std::string> warnings;                   // parts of φ that earlier trials leave open, a sentence each
  std::string policy;                                  // the name of the policy with the parameters theta
  Vector theta;
  std::vector<ForecastError> forecast;
  std::vector<std::string> notes;
  double model_s = 0;
  double search_s = 0;
  std::string file_checksum;  // of the file that the episode was told by; empty: Rehearse drove the robot
};

/// An episode of another controller, which was told before the first trial.
struct Log {
  std::string name;  // of the file
  std::string file_checksum;
  Episode episode;
  std::vector<std::string> notes;  // how the file was read
};

/// A run so far: enough to continue it as if nothing had happened.
struct History {
  std::vector<TrialRecord> trials;
  std::vector<Episode> episodes;     // of these trials
  Index told = 0;                    // how many of them the learner has been told: all but perhaps the last
  nlohmann::json learner;            // what it saved after the last it was told
  std::vector<Log> logs;             // told before the first trial
  std::optional<TrialRecord> asked;  // the trial that was asked for and is to come: what is known before it

  Index done() const { return static_cast<Index>(trials.size()); }
  bool ends_solved() const { return !trials.empty() && trials.back().solved.value_or(false); }
};

/// True if Rehearse drove none of the trials: the robot is not the plant, even where there is one.
bool was_told(const History& history);

/// The trial with the highest return, the first of equals. One that was cut short is it only where all were. There must
/// be one.
const TrialRecord& best_trial(const std::vector<TrialRecord>& trials);

}  // namespace rehearse::experiment
