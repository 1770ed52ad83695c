#include "rehearse/experiment/ask_tell.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/failures.hpp"
#include "rehearse/experiment/kept_tells.hpp"
#include "rehearse/experiment/next_files.hpp"
#include "rehearse/experiment/open_run.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

/// A run's folder and all that is needed to go on with it.
class Reopened {
 public:
  Reopened(const Catalogue& built_in, const fs::path& path, const RunOptions& options)
      : folder_(RunFolder::open(path)),
        catalogue_(with_robot_of_run(built_in, path)),
        participants_(resolve(catalogue_, folder_.spec()), options),
        run_(participants_, folder_, folder_.load()) {}

  /// The value of `step`, whose failures say what can be done about them.
  template <class Step>
  auto attempt(Step step) -> decltype(step()) {
    return with_causes(catalogue_, resolved().spec, folder_.path(), step);
  }

  /// Calls use(run); the policy's files are those of the trial that is asked for when it ends.
  template <class Use>
  void go_on(bool something_to_come, Use use) {
    run_.begin(something_to_come);
    use(run_);
    update_next_files(folder_, resolved(), run_.history());
  }

  const Resolved& resolved() const { return participants_.resolved(); }
  const RunFolder& folder() const { return folder_; }
  OpenRun& run() { return run_; }

  /// The policy's files go first: wherever this ends, none is there whose trial is not asked for.
  void drop_asked() {
    folder_.remove_next();
    run_.change_asked({});  // the next `ask` makes it again, if no logs come
  }

  /// A run that has more trials than it was to have ends with the last of them.
  void extend_to_done() {
    const Spec& spec = folder_.spec();
    const History& history = run_.history();
    if (spec.trials == 0 || history.done() < spec.trials) return;
    folder_.change_end({history.done(), spec.until_solved}, resolved().comments);
    folder_.mark_done(history.done());
  }

 private:
  RunFolder folder_;
  Catalogue catalogue_;
  Participants participants_;
  OpenRun run_;
};

/// The trial or the log by which a file is known; 0: none.
struct KnownAs {
  Index trial = 0, log = 0;
  bool known() const { return trial > 0 || log > 0; }
};

/// The place of the first, from 1; 0: there is none.
template <class All, class Is>
Index place(const All& all, Is is) {
  const auto found = std::ranges::find_if(all, is);
  return found == all.end() ? 0 : found - all.begin() + 1;
}

KnownAs known_by_bytes(const History& history, const ToldFile& file) {
  const auto same_bytes = [&](const auto& one) { return one.file_checksum == file.checksum; };
  return {place(history.trials, same_bytes), place(history.logs, same_bytes)};
}

/// By the bytes, or, once it was read, by the numbers: other ends of lines, or the copy in the run's folder, make no
/// other episode.
KnownAs known_as(const History& history, const ToldFile& file, const Task& task) {
  const KnownAs by_bytes = known_by_bytes(history, file);
  if (by_bytes.known() || !file.whole) return by_bytes;
  const Episode& read = file.whole->episode;
  return {place(history.episodes, [&](const Episode& kept) { return repeats(read, kept, task.horizon); }),
          place(history.logs, [&](const Log& log) { return repeats(read, log.episode, read.steps()); })};
}

/// True if the file follows the policy that was asked for. follows: as exactly as this says.
bool is_of_policy_asked_for(const ToldFile& file, const scenario::Scenario& scenario, const History& history,
                            decltype(follows_policy) follows) {
  return history.asked && file.whole && follows(*file.whole, scenario, *history.asked);
}

/// True if files are logs of other controllers: several are it also where the first trial was asked for already.
bool are_logs(const History& history, const TellRequest& request) {
  return history.done() == 0 && (!history.asked || request.files.size() > 1);
}

/// Throws InvalidInput where logs have the episode among them that was asked for: it would be no trial.
void refuse_trial_among_logs(const scenario::Scenario& scenario, const History& history,
                             const std::vector<ToldFile>& files) {
  for (const ToldFile& file : files)
    if (is_of_policy_asked_for(file, scenario, history, may_follow_policy))
      throw InvalidInput(fmt::format(
          "{} has the actions of the policy that was asked for: tell it alone, as trial {}; several files are logs",
          file.path.string(), history.asked->trial));
}

void check(const History& history, const std::vector<ToldFile>& files, const TellRequest& request) {
  if (request.stopped && request.stopped->reason.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InvalidInput("--stopped (in Python stopped=) says no reason: why the episode was cut short");
  if (are_logs(history, request) && request.stopped)
    throw InvalidInput(fmt::format("--stopped (in Python stopped=) is for the episode of a trial, but {}",
                                   history.asked ? "several files are logs" : "none was asked for"));
  if (are_logs(history, request)) return;
  if (!history.asked)
    throw InvalidInput(
        fmt::format("{} tells of no trial: trial {} was not asked for (`ask` comes first). Logs of other controllers "
                    "are taken before the first trial",
                    files.front().path.string(), history.done() + 1));
  if (files.size() != 1)
    throw InvalidInput(
        fmt::format("trial {} is to come, one file tells it, but {} are named", history.asked->trial, files.size()));
}

/// Throws InvalidInput where a file that is known as a trial goes on after the trial was stopped.
void refuse_what_goes_on(const TrialRecord& trial, const Episode& kept, const ToldFile& file, const Task& task) {
  if (!file.whole || !goes_on_after(file.whole->episode, kept, task)) return;
  throw InvalidInput(fmt::format(
      "{} has {} steps, of which {} were told as trial {}, stopped there; to tell the whole instead, take that "
      "back: `tell --undo` (in Python `take_back()`)",
      file.path.string(), file.whole->episode.steps(), kept.steps(), trial.trial));
}

TellResult already_told(const Resolved& resolved, const History& history, const std::vector<ToldFile>& files) {
  TellResult told{
      .resolved = resolved, .trial = {}, .logs = {}, .known_before = true, .still_asked = history.asked.has_value()};
  for (const ToldFile& file : files) {
    const KnownAs as = known_as(history, file, resolved.scenario.task);
    if (as.trial > 0) told.trial = history.trials[static_cast<std::size_t>(as.trial) - 1];
    if (as.log > 0) told.logs.push_back(history.logs[static_cast<std::size_t>(as.log) - 1]);
  }
  return told;
}

/// Makes the run what it was before logs, unless they are in it on the disk. kept: `keep_tell` came to its end.
void bring_back(const Reopened& reopened, const History& before, bool kept) {
  const RunFolder& folder = reopened.folder();
  const History on_disk = folder.load();
  if (on_disk.logs.size() != before.logs.size()) return;
  if (kept) forget_tell(folder);
  if (!before.asked) return;
  if (!on_disk.asked) folder.write_checkpoint(before);
  update_next_files(folder, reopened.resolved(), before);
}

/// Logs take the place of a policy that was asked for without them.
TellResult tell_logs(Reopened& reopened, const std::vector<ToldFile>& files) {
  const Resolved& resolved = reopened.resolved();
  std::vector<Log> logs = logs_of(files, resolved.scenario.task);
  const History before = reopened.run().history();
  bool kept = false;
  try {
    if (before.asked) reopened.drop_asked();
    keep_tell(reopened.folder(), files);
    kept = true;
    reopened.go_on(false, [&](OpenRun& run) { run.add_logs(logs); });
  } catch (...) {
    bring_back(reopened, before, kept);
    throw;
  }
  return {.resolved = resolved, .trial = {}, .logs = std::move(logs), .dropped = before.asked.has_value()};
}

TellResult tell_trial(Reopened& reopened, const std::vector<ToldFile>& files, const std::optional<Stop>& stopped) {
  const Resolved& resolved = reopened.resolved();
  const History& history = reopened.run().history();
  const ToldEpisode episode = episode_of(files.front(), resolved.scenario, *history.asked, history.trials, stopped);
  keep_tell(reopened.folder(), files);
  reopened.run().record(episode.episode, files.front().checksum, episode.notes);
  update_next_files(reopened.folder(), resolved, history);  // before anything can fail: nobody runs an old policy again
  reopened.go_on(false, [](OpenRun&) {});
  reopened.extend_to_done();
  return {.resolved = resolved, .trial = history.trials.back(), .logs = {}};
}

}  // namespace

AskResult ask_run(const Catalogue& catalogue, const fs::path& path, const RunOptions& options) {
  Reopened reopened(catalogue, path, options);
  const bool asked = reopened.run().history().asked.has_value();  // what is known of it stands in the folder
  reopened.attempt([&] {
    reopened.go_on(!asked, [&](OpenRun& run) {
      if (!asked) run.propose();
    });
  });
  return {reopened.resolved(), *reopened.run().history().asked, path / kNextFolder};
}

TellResult tell_run(const Catalogue& catalogue, const fs::path& path, const TellRequest& request,
                    const RunOptions& options) {
  if (request.files.empty()) throw InvalidInput("no file is named");
  Reopened reopened(catalogue, path, options);
  const Resolved& resolved = reopened.resolved();
  const History& history = reopened.run().history();
  Violations violations;
  std::vector<ToldFile> files = read_told_files(request.files, violations);
  violations.throw_if_any();
  std::vector<ToldFile> news;
  for (ToldFile& file : files) {
    // Bytes that are known say enough, unless a policy was asked for, which may have done the same again.
    if (history.asked || !known_by_bytes(history, file).known()) file.whole = readable(file, resolved.scenario.task);
    const KnownAs as = known_as(history, file, resolved.scenario.task);
    // A robot without noise may do exactly the same again.
    if (!as.known() ||
        (!are_logs(history, request) && is_of_policy_asked_for(file, resolved.scenario, history, follows_policy))) {
      news.push_back(std::move(file));
    } else if (as.trial > 0) {
      const auto known = static_cast<std::size_t>(as.trial) - 1;
      refuse_what_goes_on(history.trials[known], history.episodes[known], file, resolved.scenario.task);
    }
  }
  if (!news.empty()) check(history, news, request);
  if (are_logs(history, request)) refuse_trial_among_logs(resolved.scenario, history, news);
  return reopened.attempt([&] {
    if (!news.empty())
      return are_logs(history, request) ? tell_logs(reopened, news) : tell_trial(reopened, news, request.stopped);
    reopened.go_on(false, [](OpenRun&) {});  // the tables, where a kill came before them
    reopened.extend_to_done();
    return already_told(resolved, history, files);
  });
}

TakeBackResult take_back(const Catalogue& catalogue, const fs::path& path, const RunOptions& options) {
  TakeBackResult taken;
  {
    Reopened told(catalogue, path, options);
    told.attempt([&] {
      const KeptTell tell = last_tell(told.folder());
      taken = {tell.trial(), set_aside(told.folder(), tell)};
      told.run().update_learners_tables(false);
      restore(told.folder(), tell);
    });
  }
  Reopened before(catalogue, path, options);
  before.attempt([&] {
    before.go_on(false, [](OpenRun& run) { run.update_learners_tables(true); });
    forget_tell(before.folder());
  });
  return taken;
}

RunStatus status_of(const Catalogue& built_in, const fs::path& path) {
  return {read_run(built_in, path), RunFolder::is_in_use(path)};
}

}  // namespace rehearse::experiment
