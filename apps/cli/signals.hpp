#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "rehearse/core/evaluator.hpp"

namespace rehearse::apps {

/// While it lives the first SIGINT or SIGTERM is remembered and answered on standard error, so that work stops where it
/// can be continued; a second one ends the process as usual. If work has not stopped 1 s later (a factorisation, a
/// simulator's step, memory that is being written), `last_words` are printed and the process ends; folders survive
/// that. One object at a time.
class SignalWatch {
 public:
  /// last_words: called on another thread. Empty: nothing is said, and the process ends when the work does.
  explicit SignalWatch(std::function<std::string()> last_words);
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  void watch();

  std::function<std::string()> last_words_;
  std::mutex mutex_;
  std::condition_variable over_changed_;
  bool over_ = false;
  std::thread thread_;
};

/// The signal that was caught; 0 if there was none.
int caught_signal();

/// Work on so many threads, which a signal stops.
std::shared_ptr<const Evaluator> evaluator_until_signal(int threads);

/// The exit code of a process that stopped because of a signal, or because another rank was told to.
int exit_code_of_signal();

}  // namespace rehearse::apps
