#pragma once
// The inputs of `identify`: a robot with a prior, options, and logs.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/recording/recording.hpp"
#include "rehearse/study/study.hpp"

namespace rehearse::experiment {

struct IdentifyOptions {
  study::Options study;
  recording::ReadOptions read{.average = true};
  void fields(FieldVisitor& v) {
    study.fields(v);
    v.group("read", read);
  }
};

/// A robot with a prior, and how it is learned.
struct StudySetup {
  scenario::Scenario scenario;
  Task robot;                         // of the robot's own states, without its actuators, which are known
  std::optional<prior::Prior> prior;  // likewise
  IdentifyOptions options;

  /// References: this and the logs must outlive it.
  study::Problem problem(const std::vector<study::Log>& logs, const std::vector<study::Log>& held_out) const {
    return {robot, *prior, logs, held_out};
  }
};

struct StudyRequest {
  std::string robot;                 // a scenario, or the source of its file
  std::optional<std::string> prior;  // its name; empty: the first
  std::vector<std::pair<std::string, std::string>> settings;
};

/// Throws InvalidInput with everything that is wrong, violations that were found before included.
StudySetup set_up_study(const Catalogue& catalogue, const StudyRequest& request, Violations& violations);

struct ReadLog {
  std::string path;
  study::Log log;
  std::vector<std::string> notes;  // how the file was read
};

struct ReadLogs {
  std::vector<ReadLog> logs, held_out;
};

/// Files that cannot be read, or are there twice, become violations. A log has the name of its file; its path, where
/// several files have one name.
ReadLogs read_logs(const std::vector<std::string>& logs, const std::vector<std::string>& held_out,
                   const StudySetup& setup, Violations& violations);

}  // namespace rehearse::experiment
