#include "rehearse/recording/recording.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/table.hpp"
#include "rehearse/recording/columns.hpp"
#include "rehearse/recording/plausible.hpp"
#include "rehearse/recording/resample.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::recording {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr double kLittle = 0.05;  // of a control step: so little late is every loop

/// The text without what editors and robots leave at its ends. Throws InvalidInput where it is no comma-separated text.
std::string_view cleaned(std::string_view text, std::vector<std::string>& notes) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const auto control = [](unsigned char c) { return c < ' ' && c != '\n' && c != '\r' && c != '\t'; };
  if (std::ranges::any_of(text, control)) throw InvalidInput("it is no text: there are control characters in it");
  if (text.empty()) throw InvalidInput("the file is empty");
  const auto last_end = text.find_last_of('\n');
  if (last_end == std::string_view::npos)
    throw InvalidInput(text.find('\r') == std::string_view::npos
                           ? "there is no row: no line of it has an end"
                           : "its lines end with CR alone, must end with LF or CR LF");
  if (text.substr(last_end + 1).find_first_not_of(" \t") != std::string_view::npos)
    notes.emplace_back("the last row is left out: it has no end, so that it may be cut short");
  text = text.substr(0, last_end + 1);
  while (text.ends_with("\n\n") || text.ends_with("\n\r\n")) text.remove_suffix(text.ends_with("\n\n") ? 1 : 2);
  const std::string_view header = text.substr(0, text.find('\n'));
  if (header.find(',') == std::string_view::npos)
    for (const auto& [separator, name, sed] :
         {std::tuple{';', "';'", "s/,/./g; s/;/,/g"}, std::tuple{'\t', "tabs", "s/,/./g; s/\\t/,/g"}})
      if (header.find(separator) != std::string_view::npos)
        throw InvalidInput(text.find(',') == std::string_view::npos
                               ? fmt::format("columns are separated by {}, must be by ','", name)
                               : fmt::format("columns are separated by {}, must be by ',', and decimals have a comma, "
                                             "must have a point: sed '{}' makes it so",
                                             name, sed));
  return text;
}

files::Table table_of(std::string_view text, const std::string& source, std::vector<std::string>& notes) {
  try {
    return files::read_csv(cleaned(text, notes));
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", source, error.what()));
  }
}

void unwrap_angles(std::vector<Channel>& channels, const Task& task, std::vector<std::string>& notes) {
  for (std::size_t s = 0; s < channels.size(); ++s) {
    if (task.states[s].kind != StateKind::angle) continue;
    const Index turned = unwrap(channels[s], task.start_mean(static_cast<Index>(s)));
    if (turned > 0)
      notes.push_back(fmt::format("{} was wrapped, and is unwrapped at {} rows", channels[s].name, turned));
  }
}

void check_channels(Channels& channels, const Task& task, Problems& problems, std::vector<std::string>& notes) {
  unwrap_angles(channels.states, task, notes);
  unwrap_angles(channels.truths, task, notes);
  for (std::size_t s = 0; s < channels.truths.size(); ++s)
    if (task.states[s].kind == StateKind::angle)
      move_beside(channels.truths[s], channels.states[s].samples.front().value);
  const std::vector<const Channel*> rates = rates_of(channels.states, task);
  for (std::size_t s = 0; s < rates.size(); ++s) {
    check_jumps(channels.states[s], rates[s], channels.actions, problems);
    if (rates[s]) compare_with_rate(channels.states[s], *rates[s], task.dt_s, notes);
    if (task.states[s].kind == StateKind::angle) look_for_turns(channels.states[s], notes);
  }
  for (std::size_t a = 0; a < channels.actions.size(); ++a)
    keep_in_bounds(channels.actions[a], task.actions[a].bounds, problems, notes);
}

/// A sentence on rows that seem to be the control steps of a loop that is slower than the task says; else empty.
std::string slow_loop(double usual_s, double dt_s) {
  if (usual_s <= dt_s * 1.02 || usual_s >= dt_s * 3) return "";
  return fmt::format(
      ". A loop that runs so makes control steps of {:.3g} s, where the task has {} s: set dt_s, or make the loop "
      "faster",
      usual_s, dt_s);
}

/// The times of rows: those of the state with the fewest empty cells.
const std::vector<Sample>& rows_of(const Channels& channels) {
  return std::ranges::max_element(channels.states, {}, [](const Channel& c) { return c.samples.size(); })->samples;
}

/// The distance of each control step to the nearest row.
std::vector<double> away_from_rows_s(const std::vector<Sample>& samples, const Grid& grid) {
  std::vector<double> all;
  auto row = samples.begin();
  for (Index k = 0; k <= grid.steps; ++k) {
    const auto away_s = [&](auto sample) { return std::abs(sample->time_s - grid.time(k)); };
    while (std::next(row) != samples.end() && away_s(std::next(row)) <= away_s(row)) ++row;
    all.push_back(away_s(row));
  }
  return all;
}

/// A sentence where most control steps have a row of their own, and some of them do not.
std::string note_of_steps_with_rows(const Grid& grid, const Resampled& changed, const std::vector<double>& away_s) {
  const double off_s = std::ranges::max(away_s);
  if (off_s == 0)
    return fmt::format("cells are empty at {} of {} control steps: numbers are interpolated there",
                       std::max(changed.states, changed.actions), grid.steps);
  if (off_s <= kLittle * grid.dt_s)
    return fmt::format("rows are up to {:.2g} s off the control steps of {} s: numbers are interpolated", off_s,
                       grid.dt_s);
  return fmt::format("no row with numbers is near {} of {} control steps: they are interpolated there",
                     std::ranges::count_if(away_s, [&](double s) { return s > kLittle * grid.dt_s; }), grid.steps);
}

void note_resampling(const Channels& channels, const Grid& grid, const Resampled& changed,
                     const std::vector<double>& away_s, std::vector<std::string>& notes) {
  const double little_s = kLittle * grid.dt_s;
  if (grid.start_s > little_s)
    notes.push_back(
        fmt::format("step 0 is at {:.13g} s, the first time at which all columns have numbers", grid.start_s));
  if (changed.states == 0 && changed.actions == 0) return;
  const auto& rows = rows_of(channels);
  const double usual_s = (rows.back().time_s - rows.front().time_s) / static_cast<double>(rows.size() - 1);
  const bool one_row_a_step = usual_s >= grid.dt_s - little_s && changed.on_lines == 0;
  if (one_row_a_step && statistics::quantile(away_s, 0.5) <= little_s) {
    notes.push_back(note_of_steps_with_rows(grid, changed, away_s));
    return;
  }
  std::vector<std::string> how;
  if (changed.states > 0)
    how.push_back(fmt::format(
        "states are {} in {} of {} control steps of {} s",
        2 * changed.on_lines > changed.states ? "on lines through the rows around them" : "interpolated linearly",
        changed.states, grid.steps, grid.dt_s));
  if (changed.actions > 0)
    how.push_back(
        fmt::format("actions are means of what rows hold until the next, in {} of {}", changed.actions, grid.steps));
  notes.push_back(fmt::format("rows are {:.3g} s apart on average: {}{}", usual_s, fmt::join(how, "; "),
                              slow_loop(usual_s, grid.dt_s)));
}

void check_size(double bytes, const std::string& source, const ReadOptions& options) {
  if (bytes > options.max_bytes)
    throw InvalidInput(fmt::format("{}: it has {:.0f} bytes, must have at most {:.0f}: cut it, or leave out rows",
                                   source, bytes, options.max_bytes));
}

/// Appends the memory of actuators, which follows from the actions since the recording began, to the measured states.
void add_memory(Episode& episode, const Task& task) {
  if (task.memory == 0) return;
  const Matrix memory = task.actuators().memory_of(episode.actions);
  for (Matrix* states : {&episode.states, &episode.true_states}) {
    states->conservativeResize(Eigen::NoChange, task.state_size());
    states->rightCols(task.memory) = memory;
  }
}

}  // namespace

Recording read_recording(const std::string& csv_text, const std::string& source, const Task& task,
                         const ReadOptions& options) {
  check_size(static_cast<double>(csv_text.size()), source, options);
  Recording recording;
  Problems problems(source);
  const files::Table table = table_of(csv_text, source, recording.notes);
  if (table.rows.empty()) problems.add(0, "rows", "there is no row below the header");
  Channels channels = find_channels(table, task, problems, recording.notes);
  problems.throw_if_any();
  for (Channel& action : channels.actions)
    for (Sample& sample : action.samples) sample.time_s += options.action_delay_s;
  const double max_gap_s = options.max_gap_steps * task.dt_s * (1 + 1e-9);
  Grid grid = grid_of(channels, task.dt_s, max_gap_s, problems);
  if (grid.steps > options.max_steps) {
    recording.notes.push_back(fmt::format("the first {} of {} control steps are read", options.max_steps, grid.steps));
    grid.steps = options.max_steps;
    cut(channels, grid);
  }
  check_channels(channels, task, problems, recording.notes);
  check_gaps(channels, grid, max_gap_s, problems);
  problems.throw_if_any();
  const std::vector<double> away_s = away_from_rows_s(rows_of(channels), grid);
  recording.off_s = statistics::quantile(away_s, 0.9);
  Resampled changed = resample(channels, grid, options.average, recording.episode);
  recording.unaveraged = std::move(changed.unaveraged);
  note_resampling(channels, grid, changed, away_s, recording.notes);
  add_memory(recording.episode, task);
  return recording;
}

std::string read_bytes(const std::filesystem::path& path, const ReadOptions& options) {
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(path, ignored);
  if (!ignored) check_size(static_cast<double>(bytes), path.string(), options);
  return files::read_file(path, files::Links::follow);
}

}  // namespace rehearse::recording
