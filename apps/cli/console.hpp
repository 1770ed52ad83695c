#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "apps/cli/status_line.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run.hpp"

namespace rehearse::apps {

/// Shows a run on standard output: one line a trial, and a status line as it goes.
class Console final : public experiment::RunListener {
 public:
  enum class Begin { said, silent };  // said: a line is printed at the start
  explicit Console(Begin begin = Begin::said) : begins_(begin) {}

  void started(const experiment::Resolved& resolved, const std::filesystem::path& folder, Index done) override;
  void progress(Index trial, const Progress& progress) override;
  void trial_done(const experiment::TrialRecord& record) override;
  void finished(const experiment::RunResult& result);

  /// Wipes the line that is being rewritten: that work is over.
  void clear_line();

  /// Says how far work is where it reports nothing, and the first faults of the robot's programs, since programs that
  /// fail often make it slow; how often it was in all is said at the end. Any thread calls it between steps of work;
  /// the one that made this says something, once a second.
  void look();

  /// The same, if the work ends here.
  void interrupted();

  /// Any thread.
  Index trials_done() const { return done_; }

 private:
  using Clock = std::chrono::steady_clock;

  void show_progress();
  std::string time_left() const;

  std::string number(Index trial) const;
  void say_first_faults();

  Begin begins_;
  std::thread::id owner_ = std::this_thread::get_id();
  StatusLine line_;
  Index trials_ = 0;
  std::atomic<Index> done_ = 0;
  Index done_before_ = 0;
  bool says_when_solved_ = true;  // the task does
  std::string priors_;
  std::function<std::vector<std::string>()> faults_;  // of the robot's programs; null: said, or it has none
  std::vector<std::string> phi_names_;
  Index trial_ = 0;
  Progress progress_;  // the last of this trial; of no phase before the first
  Clock::time_point begin_, trial_begin_, phase_begin_, next_look_;
};

}  // namespace rehearse::apps
