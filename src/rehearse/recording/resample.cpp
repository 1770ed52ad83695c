#include "rehearse/recording/resample.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "rehearse/recording/units.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::recording {
namespace {

constexpr double kNear = 1e-4;  // of dt: a row so near to the begin of a step is taken as it is
constexpr double kEnd = 0.01;   // of dt: so much may be missing at the end of the last step,
constexpr double kLate = 0.5;   // or of the time from row to row, of dt at most: clocks of loops are late now and then

using Samples = std::vector<Sample>;

Samples::const_iterator from(const Samples& samples, double time_s) {
  return std::ranges::lower_bound(samples, time_s, {}, &Sample::time_s);
}

void check_gaps(const Channel& channel, const Grid& grid, double max_gap_s, Problems& problems) {
  const double end_s = grid.time(grid.steps);
  for (std::size_t i = 1; i < channel.samples.size(); ++i) {
    const Sample &before = channel.samples[i - 1], &after = channel.samples[i];
    const double gap_s = after.time_s - before.time_s;
    if (gap_s <= max_gap_s || after.time_s <= grid.start_s || before.time_s >= end_s) continue;
    problems.add(
        after.row, "gap",
        fmt::format("{} has no number for {:.6g} s, must have one every {:.6g} s at least ({:.3g} control steps)",
                    channel.name, gap_s, max_gap_s, max_gap_s / grid.dt_s));
  }
}

double median_gap_s(const Samples& samples) {
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < samples.size(); ++i) gaps_s.push_back(samples[i].time_s - samples[i - 1].time_s);
  return gaps_s.empty() ? 0 : statistics::quantile(gaps_s, 0.5);
}

/// Times whose gaps are too long may be in a smaller unit than they say, or seconds: says which, and how to name it.
void check_unit_of_time(const Channels& channels, double max_gap_s, Problems& problems) {
  const double gap_s = median_gap_s(channels.states.front().samples);
  const bool bare = channels.time_unit.empty();
  const double given_s = conversion(bare ? "s" : channels.time_unit, "s").value_or(1), gap = gap_s / given_s;
  if (gap < 1 || gap_s <= max_gap_s) return;
  for (const auto& [name, unit, in_s] :
       {std::tuple{"milliseconds", "ms", 1e-3}, {"microseconds", "us", 1e-6}, {"nanoseconds", "ns", 1e-9}}) {
    if (in_s >= given_s || gap * in_s > max_gap_s) continue;
    problems.add(
        1, "unit of time",
        fmt::format("{0} {1}, but looks like {2} (rows are {3:.4g} apart): if it is, call the column '{0} [{4}]'",
                    channels.time, bare ? "has no unit, so it is in s" : "is in " + channels.time_unit, name, gap,
                    unit));
    return;
  }
}

/// exact: becomes false unless the value is that of a row. Beyond the last one it goes on as it did.
double state_at(const Samples& samples, double time_s, double near_s, bool& exact) {
  auto after = from(samples, time_s - near_s);
  if (after == samples.end() && samples.size() == 1) return samples.back().value;
  if (after == samples.end()) --after;
  const bool there = std::abs(after->time_s - time_s) <= near_s;
  if (there || after == samples.begin()) return after->value;
  exact = false;
  const Sample& before = *std::prev(after);
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  return before.value + part * (after->value - before.value);
}

/// The value there of the line through the samples within half a step; empty if they are fewer than four.
std::optional<double> averaged(const Samples& samples, double time_s, double dt_s) {
  const auto begin = from(samples, time_s - dt_s / 2), end = from(samples, time_s + dt_s / 2);
  if (end - begin < 4) return std::nullopt;
  double n = 0, t = 0, x = 0, tt = 0, tx = 0;
  for (auto sample = begin; sample != end; ++sample) {
    const double since_s = sample->time_s - time_s;
    n += 1, t += since_s, x += sample->value, tt += since_s * since_s, tx += since_s * sample->value;
  }
  return (tt * x - t * tx) / (n * tt - t * t);
}

/// The mean from begin to end of what each sample holds until the next.
double mean_action(const Samples& samples, double begin_s, double end_s, double near_s, bool& exact) {
  auto next = from(samples, begin_s + near_s);
  double held = next == samples.begin() ? next->value : std::prev(next)->value;
  const bool at_begin = next != samples.begin() && std::prev(next)->time_s >= begin_s - near_s;
  if (next == samples.end() || next->time_s >= end_s - near_s) {  // one holds for the whole step
    exact = exact && at_begin;
    return held;
  }
  exact = false;
  double sum = 0, since_s = begin_s;
  for (; next != samples.end() && next->time_s < end_s; ++next) {
    sum += held * (next->time_s - since_s);
    since_s = next->time_s;
    held = next->value;
  }
  return (sum + held * (end_s - since_s)) / (end_s - begin_s);
}

/// on_lines: becomes true where a state is on a line through rows.
Matrix states_on(const std::vector<Channel>& channels, const Grid& grid, bool average, std::vector<char>& exact,
                 std::vector<char>& on_lines) {
  Matrix states(grid.steps + 1, static_cast<Index>(channels.size()));
  for (Index s = 0; s < states.cols(); ++s)
    for (Index k = 0; k <= grid.steps; ++k) {
      const Samples& samples = channels[static_cast<std::size_t>(s)].samples;
      const auto mean = average ? averaged(samples, grid.time(k), grid.dt_s) : std::nullopt;
      bool as_it_is = !mean;
      states(k, s) = mean ? *mean : state_at(samples, grid.time(k), kNear * grid.dt_s, as_it_is);
      exact[static_cast<std::size_t>(k)] &= static_cast<char>(as_it_is);
      on_lines[static_cast<std::size_t>(k)] |= static_cast<char>(mean.has_value());
    }
  return states;
}

Matrix actions_on(const std::vector<Channel>& channels, const Grid& grid, std::vector<char>& exact) {
  Matrix actions(grid.steps, static_cast<Index>(channels.size()));
  for (Index a = 0; a < actions.cols(); ++a)
    for (Index k = 0; k < grid.steps; ++k) {
      bool as_it_is = true;
      actions(k, a) = mean_action(channels[static_cast<std::size_t>(a)].samples, grid.time(k), grid.time(k + 1),
                                  kNear * grid.dt_s, as_it_is);
      exact[static_cast<std::size_t>(k)] &= static_cast<char>(as_it_is);
    }
  return actions;
}

template <class Visit>
void for_each_channel(const Channels& channels, Visit visit) {
  for (const auto* group : {&channels.states, &channels.truths, &channels.actions})
    for (const Channel& channel : *group) visit(channel);
}

double last_gap_s(const Channel& channel) {
  const Samples& samples = channel.samples;
  return samples.size() < 2 ? 0 : samples.back().time_s - samples[samples.size() - 2].time_s;
}

/// How long the last action holds: a step, or as long as rows are apart there, since the last row needs no action.
double last_hold_s(const Channel& action, const Channels& channels, double dt_s, double max_gap_s) {
  double apart_s = last_gap_s(action);
  for (const Channel& state : channels.states) apart_s = std::max(apart_s, last_gap_s(state));
  return std::max(dt_s, std::min(apart_s, max_gap_s));
}

}  // namespace

Grid grid_of(const Channels& channels, double dt_s, double max_gap_s, Problems& problems) {
  double begin_s = 0, end_s = kInf;
  for_each_channel(channels, [&](const Channel& c) { begin_s = std::max(begin_s, c.samples.front().time_s); });
  for (const Channel& state : channels.states) end_s = std::min(end_s, state.samples.back().time_s);
  for (const Channel& truth : channels.truths) end_s = std::min(end_s, truth.samples.back().time_s);
  for (const Channel& action : channels.actions)
    end_s = std::min(end_s, action.samples.back().time_s + last_hold_s(action, channels, dt_s, max_gap_s));
  const double late = kLate * std::min(1.0, median_gap_s(channels.states.front().samples) / dt_s);
  const double steps = std::floor((end_s - begin_s) / dt_s + std::max(kEnd, late));
  if (!(steps >= 1))
    problems.add(0, "length",
                 fmt::format("all columns together cover {:.6g} s, must cover a control step of {} s",
                             std::max(0.0, end_s - begin_s), dt_s));
  return {begin_s, dt_s, static_cast<Index>(std::clamp(steps, 0.0, 1e12))};
}

void cut(Channels& channels, const Grid& grid) {
  const double end_s = grid.time(grid.steps), near_s = kNear * grid.dt_s;
  for (Channel& action : channels.actions)
    std::erase_if(action.samples, [&](const Sample& sample) { return sample.time_s >= end_s - near_s; });
  for (auto* group : {&channels.states, &channels.truths})
    for (Channel& channel : *group) {
      const auto last = from(channel.samples, end_s + grid.dt_s / 2);  // a line through rows may need it
      if (last != channel.samples.end()) channel.samples.erase(std::next(last), channel.samples.end());
    }
}

void check_gaps(const Channels& channels, const Grid& grid, double max_gap_s, Problems& problems) {
  for_each_channel(channels, [&](const Channel& c) { check_gaps(c, grid, max_gap_s, problems); });
  check_unit_of_time(channels, max_gap_s, problems);
}

Resampled resample(const Channels& channels, const Grid& grid, bool average, Episode& episode) {
  std::vector<char> states(static_cast<std::size_t>(grid.steps) + 1, 1), actions = states, on_lines(states.size(), 0);
  Matrix unaveraged;
  if (average) {
    std::vector<char> exact = states, lines = on_lines;  // the counts are of the averaged states
    unaveraged = states_on(channels.states, grid, false, exact, lines);
  }
  episode.states = states_on(channels.states, grid, average, states, on_lines);
  episode.true_states =
      channels.truths.empty() ? episode.states : states_on(channels.truths, grid, average, states, on_lines);
  episode.actions = actions_on(channels.actions, grid, actions);
  episode.rewards = Vector::Zero(grid.steps);
  const auto count = [&](const std::vector<char>& marks, char mark) {
    return std::min(grid.steps, static_cast<Index>(std::ranges::count(marks, mark)));
  };
  return {count(states, 0), count(actions, 0), count(on_lines, 1), std::move(unaveraged)};
}

}  // namespace rehearse::recording
