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

  /// Wipes the line that is being rewritten.
  void clear_line() { line_.clear(); }

  /// Says the first faults of the robot's programs at once, since programs that fail often make work slow; how often it
  /// was in all is said at the end. Any thread; the one that made this looks, once a second.
  void look_for_faults();

  /// The same, if the work ends here.
  void interrupted();

  /// Any thread.
  Index trials_done() const { return done_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::string time_left(const Progress& progress) const;

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
  std::string phase_;
  double done_in_phase_ = 0;
  Clock::time_point begin_, trial_begin_, phase_begin_, next_look_;
};

}  // namespace rehearse::apps
