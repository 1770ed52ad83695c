#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run_store.hpp"

namespace rehearse::experiment {

/// Hears how a run goes, on the thread that runs it.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void started(const Resolved&, const std::filesystem::path& /*folder*/, Index /*trials done before*/) {}
  virtual void progress(Index /*trial*/, const Progress&) {}
  virtual void trial_done(const TrialRecord&) {}
};

/// Settings that do not decide results.
struct RunOptions {
  std::shared_ptr<const Evaluator> evaluator;  // null: serial
  RunListener* listener = nullptr;             // null: nobody listens
  std::function<bool()> stop;  // polled by any thread, before every step of an episode, simulated ones too;
                               // once true, the run ends with Interrupted and can be resumed
  CacheFolder cache;           // of what learners keep for other runs; null: none
};

/// The plant or the learner failed in a trial, or memory or the disk did not suffice. What was done before is kept.
class RunFailed : public std::runtime_error {
 public:
  explicit RunFailed(const std::string& message, bool resume_may_help = false)
      : std::runtime_error(message), resume_may_help_(resume_may_help) {}

  /// The cause is outside of the run: a full disk, a program that answers no more. What a run computes it computes
  /// again in the same way.
  bool resume_may_help() const { return resume_may_help_; }

 private:
  bool resume_may_help_;
};

}  // namespace rehearse::experiment
