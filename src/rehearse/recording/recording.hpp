#pragma once
// CSV files of what a robot did → an episode of a task (docs/recordings.md).

#include <filesystem>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"

namespace rehearse::recording {

struct ReadOptions {
  double action_delay_s = 0;
  bool average = false;                 // over the rows of a step, where there are many: speeds are less noisy so
  double max_gap_steps = 3;             // control steps between neighbouring samples at most: more is not interpolated
  Index max_steps = 1000000;            // of the episode; what is longer is cut
  double max_bytes = 64.0 * (1 << 20);  // of the file
  void fields(FieldVisitor& v) {
    v.number(
        "action_delay_s", action_delay_s,
        "actions act so much later than their rows say; negative: earlier, as measured torques that are filtered [s]",
        between(-1, 1));
    v.boolean("average", average, "states are those of lines through the rows within half a control step, if four are");
    v.number("max_gap_steps", max_gap_steps, "longest gap between samples that is interpolated, in control steps",
             at_least(1));
    v.integer("max_steps", max_steps, "control steps of a recording at most; what is longer is cut", at_least(1));
    v.number("max_bytes", max_bytes, expert("size of a file at most [bytes]"), at_least(1));
  }
};

/// The episode is as long as the recording, whatever the task's horizon; its rewards are 0 (rollout::as_measured makes
/// them), and that it ended is for the caller to say. `true_states` are those of the columns "true NAME" if all are
/// there, else the measured ones.
struct Recording {
  Episode episode;
  std::vector<std::string> notes;  // what was done to the numbers, a sentence each
  double off_s = 0;                // of nine in ten control steps at most, to the nearest row
  Matrix unaveraged;               // T+1 × the robot's own states, as without `average`; empty without it
};

/// Use it for logs and for episodes that Rehearse did not drive. Columns are found by name: time, every state, every
/// action, "NAME" or "NAME [unit]", in any order; a unit is converted to the task's. Step k begins at t0 + k·dt, t0 the
/// first time ≥ 0 with all columns. A row at that time is taken as it is; else states are interpolated
/// linearly (angles unwrapped before), or averaged, and an action is the mean over its step of what each row holds
/// until the next. Throws InvalidInput, "SOURCE: row N: …" for everything that is wrong (the header is row 1; the first
/// of a kind with how many more there are): columns, cells, order of times, gaps, actions out of bounds, jumps of
/// states.
Recording read_recording(const std::string& csv_text, const std::string& source, const Task& task,
                         const ReadOptions& options = {});

/// The bytes of a file, which is refused unread if it is too large.
std::string read_bytes(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace rehearse::recording
