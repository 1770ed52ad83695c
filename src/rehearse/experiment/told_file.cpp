#include "rehearse/experiment/told_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/angle.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/policy_match.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

constexpr double kRounding = 1e-9;  // of the range of an action, of numbers in a file

/// A typical change of slope from step to step: of a state at rest some 1.6 standard deviations of its noise.
double unsteadiness(const ConstVectorView& x) {
  const Index n = x.size() - 2;
  if (n < 1) return 0;
  const Vector bends = (x.head(n) - 2 * x.segment(1, n) + x.tail(n)).cwiseAbs();
  return statistics::median({bends.begin(), bends.end()});
}

constexpr const char* kAnotherUnit =
    ": is that another unit? Then `tell --undo` (in Python `take_back()`) takes the file back";

/// True where not even a start that is a sign or a decimal off is so far away.
bool is_of_another_unit(double away, double mean, double std) {
  constexpr double kFar = 30;
  const double usual = std::max(std::abs(mean), 6 * std);
  return usual > 0 && std::abs(away) > kFar * usual;
}

/// A sentence for each state that begins far from the task's start: by a tenth of its range in the episode, and by more
/// than the start varies, the state is noisy, and digits that are left out make.
std::vector<std::string> sentences_on_start(const Episode& episode, const Task& task) {
  std::vector<std::string> sentences;
  for (Index i = 0; i < task.actuators().own_states(); ++i) {
    const StateVariable& state = task.states[static_cast<std::size_t>(i)];
    const Vector x = episode.states.col(i);
    const double mean = task.start_mean(i), range = x.maxCoeff() - x.minCoeff();
    const bool angle = state.kind == StateKind::angle;
    const double away = angle ? shorter_way(x(0) - mean) : x(0) - mean;
    const double usual =
        std::max({0.1 * range, 6 * task.start_std(i), 4 * unsteadiness(x), 0.01 * std::abs(mean), kRounding});
    if (std::abs(away) > usual)
      sentences.push_back(fmt::format("starts at {} = {:.3g}{}, the task at {:.3g}{}{}", state.name, x(0),
                                      unit_text(state.unit), mean, unit_text(state.unit),
                                      is_of_another_unit(away, mean, task.start_std(i)) ? kAnotherUnit : ""));
  }
  return sentences;
}

std::string cause_of_end(const Episode& episode) {
  if (!episode.broken_limits.empty()) return fmt::format("which breaks {}", fmt::join(episode.broken_limits, ", "));
  return episode.failure.empty() ? "where `ended` holds" : "where " + episode.failure;
}

/// notes: what reading left out, which may be why there are too few.
std::string cut_short(const ToldFile& file, Index steps, Index horizon, const std::vector<std::string>& notes) {
  return fmt::format(
      "{}: {} of {} steps, which take {} rows: the last has the final state, and needs no action. If the "
      "operator cut the episode short, say why: --stopped \"…\" (in Python stopped=\"…\"){}{}",
      file.path.string(), steps, horizon, horizon + 1,
      notes.empty() ? "" : ". How the file was read: ", fmt::join(notes, "; "));
}

/// No more than so many steps. The beginning of a longer file is read anew: what is said of its rows is of these alone.
recording::Recording read_steps(const ToldFile& file, const Task& task, Index most) {
  if (file.whole && file.whole->episode.steps() <= most) return *file.whole;
  return recording::read_recording(file.bytes, file.path.string(), task, {.max_steps = most});
}

/// No more steps than a trial has.
Episode first_steps(const recording::Recording& read, const Task& task) {
  return read.episode.part(0, std::min(read.episode.steps(), task.horizon));
}

/// How far a file's rows are from the control steps.
double part_of_step(const recording::Recording& read, const Task& task) {
  return std::min(0.5, read.off_s / task.dt_s);
}

}  // namespace

std::vector<ToldFile> read_told_files(const std::vector<fs::path>& paths, Violations& violations,
                                      const recording::ReadOptions& options) {
  std::vector<ToldFile> files;
  for (const fs::path& path : paths)
    violations.attempt([&] {
      std::string bytes = recording::read_bytes(path, options);
      std::string checksum = fmt::format("{:016x}", files::checksum(bytes));
      const auto same = std::ranges::find(files, checksum, &ToldFile::checksum);
      if (same == files.end())
        files.push_back({path, std::move(bytes), std::move(checksum)});
      else
        violations.add(fmt::format("{} and {} are the same", same->path.string(), path.string()));
    });
  return files;
}

std::vector<Log> logs_of(const std::vector<ToldFile>& files, const Task& task) {
  std::vector<Log> logs;
  Violations violations;
  for (const ToldFile& file : files)
    violations.attempt([&] {
      recording::Recording read = read_steps(file, task, recording::ReadOptions().max_steps);
      for (const Log& log : logs)
        if (log.episode.has_numbers_of(read.episode))
          violations.add(fmt::format("{} and {} have the same numbers", log.name, file.path.string()));
      read.episode.rewards.resize(read.episode.steps());
      Episode episode = rollout::as_measured(std::move(read.episode), task);
      for (std::string& note : notes_on_ends(episode, task)) read.notes.push_back(std::move(note));
      logs.push_back({file.path.filename().string(), file.checksum, std::move(episode), std::move(read.notes)});
    });
  violations.throw_if_any();
  return logs;
}

std::optional<recording::Recording> readable(const ToldFile& file, const Task& task) {
  try {
    return recording::read_recording(file.bytes, file.path.string(), task);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

bool repeats(const Episode& read, const Episode& kept, Index most_steps) {
  const Index steps = kept.steps(), left = std::min(read.steps(), most_steps) - steps;
  if (steps == 0 || left < 0 || (left > 0 && !kept.ended)) return false;
  return kept.states == read.states.topRows(steps + 1) && kept.actions == read.actions.topRows(steps);
}

bool goes_on_after(const Episode& read, const Episode& kept, const Task& task) {
  const Index steps = std::min(read.steps(), task.horizon);  // what comes after them is not read
  return steps > kept.steps() && repeats(read, kept, task.horizon) &&
         rollout::judged(read.part(0, steps), task).steps() > kept.steps();
}

std::vector<std::string> notes_on_ends(const Episode& log, const Task& task) {
  constexpr double kMuch = 0.25;  // of the steps
  std::vector<std::string> notes;
  const auto note = [&](const std::string& what, Index count) {
    if (static_cast<double>(count) > kMuch * static_cast<double>(log.steps()))
      notes.push_back(
          fmt::format("{} in {} of {} steps: is a column in another unit than it says?", what, count, log.steps()));
  };
  if (task.ended) {
    Vector ended(log.steps());
    task.ended(log.true_states.bottomRows(log.steps()), ended);
    note("`ended` holds", std::ranges::count_if(ended, is_true));
  }
  std::map<std::string, Index> broken;
  if (!task.limits.empty())
    for (Index t = 0; t < log.steps(); ++t)
      for (const std::string& limit : rollout::limits_broken_by(task, log, t)) ++broken[limit];
  for (const auto& [limit, count] : broken) note(fmt::format("the limit {} is broken", limit), count);
  return notes;
}

bool follows_policy(const recording::Recording& read, const scenario::Scenario& scenario, const TrialRecord& asked) {
  return largest_deviation({first_steps(read, scenario.task)}, scenario, asked) <= kRounding;
}

bool may_follow_policy(const recording::Recording& read, const scenario::Scenario& scenario, const TrialRecord& asked) {
  return has_actions_of({first_steps(read, scenario.task), part_of_step(read, scenario.task)}, scenario, asked);
}

ToldEpisode episode_of(const ToldFile& file, const scenario::Scenario& scenario, const TrialRecord& asked,
                       const std::vector<TrialRecord>& earlier, const std::optional<Stop>& stopped) {
  const Task& task = scenario.task;
  recording::Recording read = read_steps(file, task, task.horizon);
  const Index recorded = read.episode.steps();
  const double off = part_of_step(read, task);
  ToldEpisode told{rollout::judged(std::move(read.episode), task), std::move(read.notes)};
  Episode& episode = told.episode;
  if (episode.steps() < recorded)
    told.notes.push_back(fmt::format("the episode ended at step {}, {}: {} steps after it are left out",
                                     episode.steps(), cause_of_end(episode), recorded - episode.steps()));
  const bool whole = episode.steps() == task.horizon || episode.ended;
  if (!whole && !stopped) throw InvalidInput(cut_short(file, episode.steps(), task.horizon, told.notes));
  if (whole && stopped)
    throw InvalidInput(
        fmt::format("{}: --stopped (in Python stopped=) is for an episode that was cut short, but this one {}",
                    file.path.string(), episode.ended ? "ended by itself" : "has all its steps"));
  if (stopped && stopped->at_fault)
    rollout::fail(episode, task, "stopped by the operator: " + stopped->reason);
  else if (stopped)
    told.notes.push_back(fmt::format("stopped by the operator after {} of {} steps, by no fault of the policy: {}",
                                     episode.steps(), task.horizon, stopped->reason));
  for (std::string& sentence : sentences_on_start(episode, task)) told.notes.push_back(std::move(sentence));
  for (std::string& sentence : sentences_on_policy({episode, off}, scenario, asked, earlier))
    told.notes.push_back(std::move(sentence));
  return told;
}

}  // namespace rehearse::experiment
