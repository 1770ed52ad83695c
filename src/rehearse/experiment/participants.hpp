#pragma once

#include <filesystem>
#include <memory>

#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run_options.hpp"
#include "rehearse/experiment/run_store.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::experiment {

/// The options' evaluator, or a serial one; stoppable if the options can stop.
std::shared_ptr<const Evaluator> evaluator_of(const RunOptions& options);

/// Everything of a run but its folder: makes the learner and the plant, so that wrong input is found first. One thread.
class Participants {
 public:
  Participants(Resolved resolved, const RunOptions& options);
  Participants(const Participants&) = delete;  // the learner's progress points here
  Participants& operator=(const Participants&) = delete;

  const RunOptions& options() const { return options_; }
  const Evaluator& evaluator() const { return *evaluator_; }
  const Resolved& resolved() const { return resolved_; }
  const Task& task() const { return resolved_.scenario.task; }
  learners::Learner& learner() const { return *learner_; }

  /// The robot, connected when it is first needed.
  system::Plant& plant();

  /// Tells the learner the folder of its store.
  void open_store(const std::filesystem::path& folder) { store_->open(folder); }

  /// Tells the trial that progress is about.
  void begin_trial(Index trial) { trial_ = trial; }

 private:
  learners::Setting setting();
  void report(const Progress& progress) const;

  RunOptions options_;
  std::shared_ptr<const Evaluator> evaluator_;
  Resolved resolved_;
  std::shared_ptr<RunStore> store_;
  std::unique_ptr<learners::Learner> learner_;
  std::unique_ptr<system::Plant> plant_;
  Index trial_ = 1;
};

}  // namespace rehearse::experiment
