#pragma once
// The front door: from logs to a model of the robot, its parameters and forecasts.

#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/events.hpp"
#include "rehearse/study/bands.hpp"
#include "rehearse/study/hints.hpp"
#include "rehearse/study/log_model.hpp"

namespace rehearse::study {

struct Log {
  std::string name;
  Episode episode;
  Matrix measured;  // T+1 × dx, what forecasts are compared with: the episode's states, or those before averaging
};

/// Use robot_alone for a robot with actuators: task, prior and logs are of its own states, and of the actions that move
/// it. References must outlive it.
struct Problem {
  const Task& task;
  const prior::Prior& prior;
  const std::vector<Log>& logs;
  const std::vector<Log>& held_out;
};

/// Logs that were forecast without having been learned from.
struct Tested {
  std::vector<std::string> logs;
  std::vector<Vector> offsets;                   // of each log, dx
  std::vector<Forecasts> model, prior_as_given;  // of each log
  Accuracy of_model, of_prior;
};

/// Changes of states in a step and the models' errors, root mean squares over the rows learned from.
struct StepErrors {
  Vector change, prior_as_given, prior, model;  // dx; of the last three what they leave
};

struct Study {
  LogModel model;  // of all logs
  std::vector<LogModel> without;
  std::vector<double> horizons_s;
  Matrix calibration;  // horizons × dx, from the logs left out
  Tested left_out_logs, held_out;
  Beyond beyond = Beyond::nothing;   // what was learned beyond the prior's parameters
  std::optional<double> gps_worsen;  // where that was chosen: errors with GPs over those without (geometric mean)
  StepErrors steps;
  std::vector<Hint> hints;  // none of logs in which nothing moves
  std::string odd_log;      // a sentence on a log that is as if of another robot; empty: none

  /// Half of the 95 % band of a state's forecast, whose deviation by the model is this.
  double half_band(std::size_t horizon, Index state, double deviation) const {
    return identification::kNormal * calibration(static_cast<Index>(horizon), state) * deviation;
  }
};

/// Learns from all logs, and from all but one of them (at most four times; of a single log, from either half): the logs
/// left out calibrate the bands, choose whether GPs are used, and say whether parameters agree. Then forecasts the
/// held-out logs. The same bytes for any number of threads. Throws InvalidInput where logs are too short.
Study study_logs(const Problem& problem, const Options& options, const Evaluator& evaluator,
                 const ProgressSink& progress = {});

}  // namespace rehearse::study
