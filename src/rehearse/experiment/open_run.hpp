#pragma once

#include <string>
#include <vector>

#include "rehearse/experiment/participants.hpp"
#include "rehearse/experiment/run_folder.hpp"

namespace rehearse::experiment {

/// A run and its folder, a trial at a time: `begin`, then `propose` and `conclude` in turn. All that one of them did is
/// on the disk when it returns. A kill at any instant costs no more than the step that it interrupts, and changes
/// nothing of what follows. Throws RunFailed and Interrupted. One thread.
class OpenRun {
 public:
  /// References must outlive it.
  OpenRun(Participants& participants, const RunFolder& folder, History history)
      : parts_(participants), folder_(folder), history_(std::move(history)) {}

  /// Brings the tables, and the learner, to where the history ends. The learner only if something is to come.
  void begin(bool something_to_come);

  const History& history() const { return history_; }

  /// Replaces what was asked for, on the disk, too. Empty: the next `propose` makes the same again, unless logs come.
  void change_asked(std::optional<TrialRecord> asked);

  /// Logs for the learner, before the first trial. None may have been asked for. Throws InvalidInput, with nothing
  /// kept, where it cannot learn from logs.
  void add_logs(std::vector<Log> logs);

  /// The learner's tables of all that it was told; `keep` says whether they are to be there.
  void update_learners_tables(bool keep);

  /// The next trial's policy. The same until it is concluded, whatever happens to the process.
  const learners::Proposal& propose();

  /// Records the episode of the trial that was asked for; the learner, which may take long or fail, is told by the next
  /// `begin`. file_checksum: of the file that says so, if it is one. notes: of how it was read.
  void record(const Episode& episode, const std::string& file_checksum = "",
              const std::vector<std::string>& notes = {});

  /// Records the episode of what was proposed, so that no robot has to repeat it, and tells the learner.
  void conclude(const Episode& episode);

 private:
  const std::filesystem::path& path() const { return folder_.path(); }
  void catch_up();
  void load_learner();
  const learners::Proposal& ask(Index trial, const TrialRecord* known);
  Episode as_told(const Episode& episode) const;
  std::vector<Episode> as_told(const std::vector<Log>& logs) const;
  void tell_last();
  void announce() const;
  void note_lost_rows(TrialRecord& record);
  void predict(Index trial, const learners::Proposal& proposal) const;
  void draw(const char* kind, Index trial, const Matrix& states) const;
  double interaction_s(const Episode& last) const;
  void publish_logs() const;
  void publish() const;
  void evaluate_last();

  Participants& parts_;
  const RunFolder& folder_;
  History history_;
  Index lost_rows_ = 0;                           // of programs, as far as they are noted
  const learners::Proposal* proposal_ = nullptr;  // of the trial that is asked for, once the learner has it
};

}  // namespace rehearse::experiment
