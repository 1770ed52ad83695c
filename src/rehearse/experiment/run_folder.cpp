#include "rehearse/experiment/run_folder.hpp"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/abandoned.hpp"
#include "rehearse/experiment/checkpoint.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/experiment/tables.hpp"
#include "rehearse/files/new_folder.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

constexpr const char *kCheckpoint = "checkpoint", *kDone = "done", *kFailed = "failed";

fs::path trial_file(const fs::path& folder, Index trial) { return folder / fmt::format("trial-{:03}.csv", trial); }

fs::path log_file(const fs::path& run, Index log) { return run / "logs" / fmt::format("log-{:03}.csv", log); }

fs::path motion_file(const fs::path& run, const char* kind, Index trial) {
  return run / "motion" / fmt::format("{}-{:03}.json", kind, trial);
}

/// True if the spec alone does not give what is in the history.
bool has_told_files(const History& history) {
  return !history.logs.empty() ||
         std::ranges::any_of(history.trials, [](const TrialRecord& trial) { return !trial.file_checksum.empty(); });
}

void say_that_told(const fs::path& spec) {
  const std::string text = files::read_file(spec), told = of_told_run(text);
  if (told != text) files::write_file(spec, told, files::Durability::power);
}

std::string already_exists(const fs::path& path) {
  return fmt::format("{} already exists and is never overwritten; name another folder, or continue a run with `resume`",
                     path.string());
}

}  // namespace

RunFolder::RunFolder(fs::path path, Spec spec, files::FolderLock lock)
    : path_(std::move(path)), spec_(std::move(spec)), fingerprint_(fingerprint(spec_)), lock_(std::move(lock)) {}

void RunFolder::require_absent(const fs::path& path) {
  if (fs::exists(fs::symlink_status(files::without_slash(path)))) throw InvalidInput(already_exists(path));
}

RunFolder RunFolder::create(const fs::path& given, const Spec& spec, const Comments& comments,
                            const std::optional<RobotFile>& robot) {
  const fs::path path = files::without_slash(given);
  static std::mutex making;  // a process makes one folder of a name at a time
  const std::lock_guard one_at_a_time(making);
  require_absent(path);
  const std::string text = spec.trials == 0 ? of_told_run(to_toml(spec, comments)) : to_toml(spec, comments);
  require_readable(spec, text);  // not after hours of trials
  remove_abandoned(path);
  files::NewFolder folder(path);
  for (const char* inner : kFirstFolders) fs::create_directory(folder.hidden() / inner);
  files::FolderLock lock(folder.hidden());
  files::write_file(folder.hidden() / kSpecFile, text, files::Durability::power);
  if (robot) keep_robot(*robot, folder.hidden());
  files::write_file(folder.hidden() / kCheckpoint, to_checkpoint({}, fingerprint(spec)), files::Durability::power);
  if (!folder.appear()) throw InvalidInput(already_exists(path));
  return {path, spec, std::move(lock)};
}

namespace {

Spec spec_of(const fs::path& folder) {
  const fs::path spec = folder / kSpecFile;
  return from_toml(files::read_file(spec), spec.string());
}

History history_of(const fs::path& folder, std::uint64_t fingerprint) {
  try {
    return from_checkpoint(files::read_file(folder / kCheckpoint), fingerprint);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", folder.string(), error.what()));
  }
}

/// Its path, if it has what a run folder has.
fs::path checked_run_folder(const fs::path& given) {
  fs::path path = files::without_slash(given);
  if (!fs::is_directory(path)) throw InvalidInput(fmt::format("{} is not a folder", path.string()));
  for (const char* file : {kSpecFile, kCheckpoint})
    if (!fs::exists(path / file))
      throw InvalidInput(fmt::format("{} is not a run folder: it has no {}", path.string(), file));
  return path;
}

/// Writing into a folder that is a link would change files outside of the run.
void refuse_linked_folders(const fs::path& run) {
  for (const fs::directory_entry& entry : fs::directory_iterator(run))
    if (entry.is_symlink() && entry.is_directory())
      throw InvalidInput(fmt::format("{} is a link, must be a folder of the run", entry.path().string()));
}

}  // namespace

RunFolder RunFolder::open(const fs::path& given) {
  const fs::path path = checked_run_folder(given);
  refuse_linked_folders(path);
  files::FolderLock lock(path);
  return {path, spec_of(path), std::move(lock)};
}

RunFolder::Contents RunFolder::read(const fs::path& given) {
  const fs::path path = checked_run_folder(given);
  Contents contents{.spec = spec_of(path), .history = {}};
  contents.history = history_of(path, fingerprint(contents.spec));
  return contents;
}

bool RunFolder::is_in_use(const fs::path& folder) { return files::FolderLock::is_held(folder); }

void RunFolder::change_end(Until until, const Comments& comments) {
  if (until.trials == spec_.trials && until.solved == spec_.until_solved) return;
  Spec changed = spec_;
  changed.trials = until.trials;
  changed.until_solved = until.solved;
  const std::string text = to_toml(changed, comments);
  const bool told = fs::exists(path_ / kToldFolder);
  files::write_file(path_ / kSpecFile, told ? of_told_run(text) : text, files::Durability::power);
  spec_ = std::move(changed);
  mark_unfinished();
}

History RunFolder::load() const { return history_of(path_, fingerprint_); }

History RunFolder::load(const fs::path& folder) const { return history_of(folder, fingerprint_); }

void RunFolder::write_checkpoint(const History& history) const {
  files::write_file(path_ / kCheckpoint, to_checkpoint(history, fingerprint_), files::Durability::power);
}

void RunFolder::write_tables(const History& history, const Resolved& resolved) const {
  if (has_told_files(history)) say_that_told(path_ / kSpecFile);
  files::write_file(path_ / "trials.csv",
                    trials_csv(history.trials, tunable_names(resolved.prior), resolved.scenario.evaluations > 0));
  files::write_file(path_ / "timings.csv", timings_csv(history.trials));
  files::write_file(path_ / "errors.csv", errors_csv(history.trials, resolved.scenario.task));
  files::write_file(path_ / "identifiability.csv", identifiability_csv(history.trials));
  files::write_file(path_ / "notes.csv", notes_csv(history.trials));
  if (!resolved.scenario.task.limits.empty()) files::write_file(path_ / "limits.csv", limits_csv(history.trials));
  files::write_file(path_ / "policy.json", policies_json(history.trials, resolved));
  if (!history.logs.empty()) files::write_file(path_ / "logs.csv", logs_csv(history.logs, resolved.scenario.task));
}

void RunFolder::write_prediction(Index trial, const std::string& csv) const {
  fs::create_directories(path_ / "predictions");  // archives and Git lose empty folders
  files::write_file(trial_file(path_ / "predictions", trial), csv);
}

fs::path RunFolder::trajectory_of(Index trial) { return trial_file("trajectories", trial); }

void RunFolder::write_trajectory(Index trial, const std::string& csv) const {
  fs::create_directories(path_ / "trajectories");
  files::write_file(path_ / trajectory_of(trial), csv);
}

void RunFolder::write_log(Index log, const std::string& csv) const {
  fs::create_directories(path_ / "logs");
  files::write_file(log_file(path_, log), csv);
}

void RunFolder::write_next(const std::string& name, const std::string& text) const {
  fs::create_directories(path_ / kNextFolder);
  files::write_file(path_ / kNextFolder / name, text);
}

void RunFolder::remove_next() const {
  // The last two are made by the commands that `ask` prints. Other files are the user's.
  for (const char* name : {"policy.h", "policy.json", "policy.py", "test", "__pycache__"})
    fs::remove_all(path_ / kNextFolder / name);
  std::error_code not_empty;
  fs::remove(path_ / kNextFolder, not_empty);
}

void RunFolder::write_motion(const char* kind, Index trial, const std::string& json) const {
  fs::create_directories(path_ / "motion");  // a scenario that cannot be drawn has none
  files::write_file(motion_file(path_, kind, trial), json);
}

void RunFolder::write_archive(const std::string& bytes) const {
  const fs::path path = path_ / "archive.bin";
  if (!files::holds(path, bytes)) files::write_file(path, bytes);
}

void RunFolder::write_learners_table(const learners::Table& table) const {
  files::write_file(path_ / (table.name + ".csv"), learners_csv(table));
}

void RunFolder::remove_learners_table(const learners::Table& table) const { fs::remove(path_ / (table.name + ".csv")); }

void RunFolder::remove_after(const History& history) const {
  const Index trial = history.done() + 1, foreseen = history.asked ? trial + 1 : trial;
  fs::remove(path_ / trajectory_of(trial));
  fs::remove(motion_file(path_, "trial", trial));
  fs::remove(trial_file(path_ / "predictions", foreseen));
  fs::remove(motion_file(path_, "prediction", foreseen));
  const auto kept = static_cast<Index>(history.logs.size());
  Index last = kept;
  while (fs::exists(log_file(path_, last + 1))) ++last;
  for (Index log = last; log > kept; --log) fs::remove(log_file(path_, log));  // a kill leaves no gap in the numbers
  if (history.logs.empty()) fs::remove(path_ / "logs.csv");
  std::error_code not_empty;
  for (const char* folder : {"motion", "logs"}) fs::remove(path_ / folder, not_empty);
}

void RunFolder::mark_done(Index trials) const { files::write_file(path_ / kDone, fmt::format("{} trials\n", trials)); }

void RunFolder::mark_unfinished() const { fs::remove(path_ / kDone); }

void RunFolder::keep_failure(const fs::path& path, const std::string& why) noexcept try {
  if (fs::exists(path / kCheckpoint)) files::write_file(path / kFailed, why + "\n");
} catch (...) {  // the failure itself is the one to report
}

void RunFolder::forget_failure() const { fs::remove(path_ / kFailed); }

}  // namespace rehearse::experiment
