#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/files/write.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::experiment {

inline constexpr const char* kToldFolder = "told";  // what each `tell` was told (kept_tells.hpp)

inline constexpr const char* kNextFolder = "next";  // of the policy that was asked for

/// The folder of one run, locked while this lives. The checkpoint is the truth and each file is replaced in one step:
/// after a kill at any instant, `load` and `write_tables` bring the rest up to date. One thread, but for the static
/// functions, which any thread may call.
class RunFolder {
 public:
  /// Throws InvalidInput if there is anything of that name.
  static void require_absent(const std::filesystem::path& path);

  /// A new folder with a complete spec and no trial. It appears in one step, or not at all.
  /// Throws InvalidInput if there is anything of that name, or if the spec would not be read back as it is.
  /// robot: the file that describes the robot, if there is one; it is kept, with the files that it names.
  static RunFolder create(const std::filesystem::path& path, const Spec& spec, const Comments& comments = {},
                          const std::optional<RobotFile>& robot = {});

  /// Throws InvalidInput if it is no run folder, cannot be read, or is in use.
  static RunFolder open(const std::filesystem::path& path);

  /// A run as its folder has it now, without the lock. Throws as `open` and `load` do.
  struct Contents {
    Spec spec;
    History history;
  };
  static Contents read(const std::filesystem::path& path);
  static bool is_in_use(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const Spec& spec() const { return spec_; }
  void change_end(Until until, const Comments& comments = {});

  /// Throws InvalidInput if the checkpoint is truncated, damaged, or does not belong to spec.toml.
  History load() const;

  /// Loads a checkpoint of this run from another folder, in the same way.
  History load(const std::filesystem::path& folder) const;

  void write_checkpoint(const History& history) const;

  /// Every table that follows from the history, and the first line of spec.toml, where files told of trials or logs.
  void write_tables(const History& history, const Resolved& resolved) const;

  /// Files about a trial: what the model expected, and what happened.
  void write_prediction(Index trial, const std::string& csv) const;
  static std::filesystem::path trajectory_of(Index trial);  // its file, in the folder
  void write_trajectory(Index trial, const std::string& csv) const;

  /// A log that was told before the first trial, from 1.
  void write_log(Index log, const std::string& csv) const;

  /// A file of the policy that was asked for; none is left of a trial that is over. Files of others stay.
  void write_next(const std::string& name, const std::string& text) const;
  void remove_next() const;

  /// The robot's motion, recorded or predicted. kind: "trial" or "prediction".
  void write_motion(const char* kind, Index trial, const std::string& json) const;

  /// A learner's archive of policies (qd/archive_bytes.hpp), unless it is there already.
  void write_archive(const std::string& bytes) const;

  /// A table of the learner: NAME.csv.
  void write_learners_table(const learners::Table& table) const;
  void remove_learners_table(const learners::Table& table) const;

  /// Removes the files written after a history: of one trial, or of logs and the trial that was asked for.
  void remove_after(const History& history) const;

  /// Marks the run as complete after so many trials, or as not.
  void mark_done(Index trials) const;
  void mark_unfinished() const;

  /// Why work on a run failed, for who comes later; nothing where that cannot be written.
  static void keep_failure(const std::filesystem::path& path, const std::string& why) noexcept;
  void forget_failure() const;

 private:
  RunFolder(std::filesystem::path path, Spec spec, files::FolderLock lock);

  std::filesystem::path path_;
  Spec spec_;
  std::uint64_t fingerprint_;  // of the spec, whatever its end
  files::FolderLock lock_;
};

}  // namespace rehearse::experiment
