#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/learners/learner.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::experiment {

/// A robot or a learner that this build leaves out.
struct NotBuilt {
  std::string name;
  std::string reason;  // "DART 6.12 was not found"
};

/// A file that comes with the program.
struct NamedText {
  std::string name, text;
};

/// A robot that a file describes.
struct RobotFile {
  std::string name;    // of its scenario
  std::string source;  // the file
  std::string text;
  std::vector<scenario::NamedFile> files;  // that it names
};

/// A checksum of its text, and of the names and bytes of its files, where there are some.
std::string checksum_of(const RobotFile& robot);

/// Reads the files of a folder that a robot's file names.
scenario::ReadFile files_in(const std::filesystem::path& folder);

/// A robot that can be made. Its builders have that name.
struct NamedScenario {
  std::string name;
  scenario::MakeBuilder make;
};

NamedScenario named(scenario::MakeBuilder make);

/// Reads a robot's file, once for all of its builders.
using ReadRobot = std::function<scenario::MakeBuilder(std::string_view text, const std::string& source,
                                                      const scenario::ReadFile& read_file)>;

/// The robots, learners and presets of a program. apps generates one from their folders; rehearse/cli/cli.hpp adds
/// those of a program of one's own. A value; every call makes new builders, because their options can be set.
struct Catalogue {
  std::vector<NamedScenario> scenarios;
  std::vector<std::function<std::vector<std::unique_ptr<learners::LearnerBuilder>>()>> learner_families;
  std::vector<NotBuilt> not_built;
  ReadRobot read_robot;                    // null: this program reads no robots from files
  std::vector<RobotFile> robots;           // whose scenarios are there, too
  std::vector<NamedText> presets;          // "as-published"
  std::vector<NamedText> default_presets;  // each under the name of its scenario, where it applies unasked
  bool of_run = false;                     // a run that is there is read, which another program may have begun

  std::vector<std::unique_ptr<scenario::ScenarioBuilder>> scenario_builders() const;
  std::vector<std::unique_ptr<learners::LearnerBuilder>> learner_builders() const;

  /// The catalogue with the robot of a file. One with a robot of the same text is returned as it is, and nothing is
  /// read. folder: where the files are that it names. Throws InvalidInput if it is none, or has the name of another
  /// scenario.
  Catalogue with_robot(const std::string& text, const std::string& source, const std::filesystem::path& folder) const;

  /// The name of the scenario of a robot that came from this file; else what is given, a name itself.
  std::string scenario_name(const std::string& name_or_source) const;

  /// The file of a scenario; null if it has none.
  const RobotFile* robot(const std::string& scenario) const;

  /// Null if there is none of that name.
  std::unique_ptr<scenario::ScenarioBuilder> scenario(const std::string& name) const;
  std::unique_ptr<learners::LearnerBuilder> learner(const std::string& name) const;

  /// Throws InvalidInput, with why, if there is none of that name.
  std::unique_ptr<scenario::ScenarioBuilder> scenario_or_throw(const std::string& name) const;

  /// The scenario or learner of that name, if the build leaves it out; else null.
  const NotBuilt* left_out(const std::string& name) const;

  /// One line that says why there is no `kind` ("scenario", "learner") of that name, and what is closest to it.
  std::string why_missing(const std::string& kind, const std::string& name) const;

  /// One line that says that this learner cannot begin with a policy, and which can.
  std::string why_no_start(const std::string& learner) const;
};

/// "unknown KIND 'NAME', did you mean 'X'? (known: …)"
std::string unknown_name(const std::string& kind, const std::string& name, const std::vector<std::string>& known);

}  // namespace rehearse::experiment
