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

  /// The value of use(run); the policy's files are those of the trial that is asked for when it ends.
  template <class Use>
  void go_on(bool something_to_come, Use use) {
    with_causes(catalogue_, resolved().spec, [&] {
      run_.begin(something_to_come);
      use(run_);
      update_next_files(folder_, resolved(), run_.history());
      return 0;
    });
  }

  const Resolved& resolved() const { return participants_.resolved(); }
  const RunFolder& folder() const { return folder_; }
  OpenRun& run() { return run_; }

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

KnownAs known_as(const History& history, const std::string& checksum) {
  const auto place = [&](const auto& all) -> Index {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.file_checksum == checksum; });
    return found == all.end() ? 0 : found - all.begin() + 1;
  };
  return {place(history.trials), place(history.logs)};
}

/// True if the file follows the policy that was asked for: a robot without noise may do exactly the same again.
bool is_of_policy_asked_for(const ToldFile& file, const scenario::Scenario& scenario, const History& history) {
  return history.asked && follows_policy(file, scenario, *history.asked);
}

void check(const History& history, const std::vector<ToldFile>& files, const TellRequest& request) {
  if (history.asked && files.size() != 1)
    throw InvalidInput(
        fmt::format("trial {} is to come, one file tells it, but {} are named", history.asked->trial, files.size()));
  if (!history.asked && history.done() > 0)
    throw InvalidInput(fmt::format(
        "{} tells of no trial: trial {} was not asked for. Logs of other controllers are taken before the first trial",
        files.front().path.string(), history.done() + 1));
  if (!history.asked && request.stopped)
    throw InvalidInput("--stopped is for the episode of a trial, but none was asked for");
}

TellResult already_told(const Resolved& resolved, const History& history, const std::vector<ToldFile>& files) {
  TellResult told{.resolved = resolved, .trial = {}, .logs = {}, .known_before = true};
  for (const ToldFile& file : files) {
    const KnownAs as = known_as(history, file.checksum);
    if (as.trial > 0) told.trial = history.trials[static_cast<std::size_t>(as.trial) - 1];
    if (as.log > 0) told.logs.push_back(history.logs[static_cast<std::size_t>(as.log) - 1]);
  }
  return told;
}

}  // namespace

AskResult ask_run(const Catalogue& catalogue, const fs::path& path, const RunOptions& options) {
  Reopened reopened(catalogue, path, options);
  reopened.go_on(true, [](OpenRun& run) { run.propose(); });
  return {reopened.resolved(), *reopened.run().history().asked, path / kNextFolder};
}

TellResult tell_run(const Catalogue& catalogue, const fs::path& path, const TellRequest& request,
                    const RunOptions& options) {
  if (request.files.empty()) throw InvalidInput("no file is named");
  Reopened reopened(catalogue, path, options);
  const Resolved& resolved = reopened.resolved();
  const History& history = reopened.run().history();
  Violations violations;
  const std::vector<ToldFile> files = read_told_files(request.files, violations);
  violations.throw_if_any();
  std::vector<ToldFile> news;
  for (const ToldFile& file : files)
    if (!known_as(history, file.checksum).known() || is_of_policy_asked_for(file, resolved.scenario, history))
      news.push_back(file);
  if (news.empty()) {
    reopened.go_on(false, [](OpenRun&) {});  // the tables, where a kill came before them
    reopened.extend_to_done();
    return already_told(resolved, history, files);
  }
  check(history, news, request);
  TellResult told{.resolved = resolved, .trial = {}, .logs = {}};
  if (!history.asked) {
    std::vector<Log> logs = logs_of(news, resolved.scenario.task);
    keep_tell(reopened.folder(), news);
    try {
      reopened.go_on(false, [&](OpenRun& run) { run.add_logs(logs); });
    } catch (const InvalidInput&) {
      forget_tell(reopened.folder());
      throw;
    }
    told.logs = std::move(logs);
    return told;
  }
  const ToldEpisode episode = episode_of(news.front(), resolved.scenario, *history.asked, request.stopped);
  keep_tell(reopened.folder(), news);
  reopened.run().record(episode.episode, news.front().checksum, episode.notes);
  update_next_files(reopened.folder(), resolved, history);  // before anything can fail: nobody runs an old policy again
  reopened.go_on(false, [](OpenRun&) {});
  reopened.extend_to_done();
  told.trial = history.trials.back();
  return told;
}

TakeBackResult take_back(const Catalogue& catalogue, const fs::path& path, const RunOptions& options) {
  TakeBackResult taken;
  {
    Reopened told(catalogue, path, options);
    const KeptTell tell = last_tell(told.folder());
    taken = {tell.trial(), set_aside(told.folder(), tell)};
    told.run().update_learners_tables(false);
    restore(told.folder(), tell);
  }
  Reopened before(catalogue, path, options);
  before.go_on(false, [](OpenRun& run) { run.update_learners_tables(true); });
  forget_tell(before.folder());
  return taken;
}

RunStatus status_of(const Catalogue& built_in, const fs::path& path) {
  auto [spec, history] = RunFolder::read(path);
  return {resolve_begun(with_robot_of_run(built_in, path), spec), std::move(history), RunFolder::is_in_use(path)};
}

}  // namespace rehearse::experiment
