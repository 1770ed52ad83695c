#include "rehearse/recording/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/core/turns.hpp"
#include "rehearse/recording/rates.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::recording {
namespace {

constexpr double kRounding = 1e-3;  // of an action's range
constexpr double kOutlier = 10;     // times what is usual
constexpr double kMuchLate = 0.1;   // of a control step
constexpr std::ptrdiff_t kAround = 4;

std::vector<double> values_of(const Channel& channel) {
  std::vector<double> values;
  for (const Sample& sample : channel.samples) values.push_back(sample.value);
  return values;
}

/// The width in which nine of ten values are.
double spread(const Channel& channel) {
  const std::vector<double> values = values_of(channel);
  return statistics::quantile(values, 0.95) - statistics::quantile(values, 0.05);
}

/// The third largest of those around i: a sample that is wrong makes two large changes, in and out.
double usual_around(const std::vector<double>& sizes, std::ptrdiff_t i) {
  const auto begin = sizes.begin() + std::max<std::ptrdiff_t>(0, i - kAround);
  const auto end = sizes.begin() + std::min<std::ptrdiff_t>(std::ssize(sizes), i + kAround + 1);
  std::vector<double> around(begin, end);
  if (around.size() < 3) return INFINITY;
  std::nth_element(around.begin(), around.begin() + 2, around.end(), std::greater<>());
  return around[2];
}

/// The change that nine of ten do not exceed; where a state is at rest for so long, the smallest one, which is a step
/// of its sensor's resolution.
double usual_change(const std::vector<double>& sizes) {
  const double usual = statistics::quantile(sizes, 0.9);
  if (usual > 0) return usual;
  double smallest = INFINITY;
  for (const double size : sizes)
    if (size > 0) smallest = std::min(smallest, size);
  return smallest;
}

/// The rate at a time, held from its last sample.
double held(const Channel& rate, double time_s) {
  const auto after = std::ranges::upper_bound(rate.samples, time_s, {}, &Sample::time_s);
  return after == rate.samples.begin() ? after->value : std::prev(after)->value;
}

/// The change until sample i that a rate says.
double expected_change(const Channel& state, const Channel& rate, std::size_t i) {
  const double from_s = state.samples[i - 1].time_s, to_s = state.samples[i].time_s;
  return 0.5 * (to_s - from_s) * (held(rate, from_s) + held(rate, to_s));
}

/// Changes between neighbouring samples beyond those of the rate, and the most that it ever allows.
struct Changes {
  std::vector<double> beyond, allowed;
};

Changes changes_of(const Channel& state, const Channel* rate) {
  Changes changes;
  const double range = spread(state);
  double fastest = 0;
  if (rate)
    for (const Sample& sample : rate->samples) fastest = std::max(fastest, std::abs(sample.value));
  for (std::size_t i = 1; i < state.samples.size(); ++i) {
    const Sample &a = state.samples[i - 1], &b = state.samples[i];
    const double dt = b.time_s - a.time_s;
    const double expected = rate ? expected_change(state, *rate, i) : 0;
    changes.beyond.push_back(std::abs(b.value - a.value - expected));
    changes.allowed.push_back(rate ? std::max(2 * fastest * dt, 0.05 * range) : range);
  }
  return changes;
}

/// 0 where the two do not have the same rows.
double lateness_of(const Channel& state, const Channel& rate) {
  if (!std::ranges::equal(state.samples, rate.samples, {}, &Sample::time_s, &Sample::time_s)) return 0;
  const auto numbers = [](const Channel& channel, double Sample::*member) {
    Vector all(std::ssize(channel.samples));
    std::ranges::transform(channel.samples, all.begin(), member);
    return all;
  };
  return lateness_s(numbers(state, &Sample::time_s), numbers(state, &Sample::value), numbers(rate, &Sample::value));
}

/// How far each action is from its median at the samples of a state.
std::vector<std::vector<double>> deviations_of(const std::vector<Channel>& actions, const Channel& state) {
  std::vector<std::vector<double>> all;
  for (const Channel& action : actions) {
    if (action.samples.empty()) continue;
    std::vector<double> sizes;
    for (const Sample& sample : state.samples) sizes.push_back(held(action, sample.time_s));
    const double median = statistics::median(sizes);
    for (double& size : sizes) size = std::abs(size - median);
    all.push_back(std::move(sizes));
  }
  return all;
}

/// True if an action from sample i on, or the one before, stands out as a change does that is so many `times` as large
/// as those around it, within a factor of two. sizes: its deviations.
bool is_push(const std::vector<double>& sizes, std::size_t i, double times) {
  for (std::size_t at = i > 0 ? i - 1 : 0; at <= i; ++at)
    if (sizes[at] > 0.5 * times * usual_around(sizes, static_cast<std::ptrdiff_t>(at))) return true;
  return false;
}

}  // namespace

Index unwrap(Channel& angle, double start) {
  const std::vector<double> values = values_of(angle);
  const auto [low, high] = std::ranges::minmax(values);
  Index turned = 0;
  if (high - low > kTurn * (1 + 1e-6)) return 0;
  double turns = within_one_turn(low, high) ? turns_towards(start, values.front()) : 0;
  angle.samples.front().value += kTurn * turns;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double change = values[i] - values[i - 1];
    if (std::abs(change) > kTurn / 2) turns -= std::copysign(1, change), ++turned;
    angle.samples[i].value += kTurn * turns;
  }
  return turned;
}

void move_beside(Channel& angle, double start) {
  const double turns = turns_towards(start, angle.samples.front().value);
  for (Sample& sample : angle.samples) sample.value += kTurn * turns;
}

void keep_in_bounds(Channel& action, Interval bounds, Problems& problems, std::vector<std::string>& notes) {
  const double rounding = kRounding * (bounds.high - bounds.low);
  Index clipped = 0;
  for (Sample& sample : action.samples) {
    const double inside = std::clamp(sample.value, bounds.low, bounds.high);
    if (inside == sample.value) continue;
    if (std::abs(sample.value - inside) > rounding)
      problems.add(sample.row, "bounds of " + action.name,
                   fmt::format("{} = {}{}, must be in {} to {}", action.name, sample.value, unit_text(action.unit),
                               bounds.low, bounds.high));
    sample.value = inside;
    ++clipped;
  }
  if (clipped > 0)
    notes.push_back(
        fmt::format("{} is clipped to its bounds in {} rows, from less than a thousandth of their range "
                    "beyond",
                    action.name, clipped));
}

std::vector<const Channel*> rates_of(const std::vector<Channel>& states, const Task& task) {
  std::vector<const Channel*> rates(states.size(), nullptr);
  for (const Kinematics::Pair& pair : task.kinematics().pairs)
    rates[static_cast<std::size_t>(pair.position)] = &states[static_cast<std::size_t>(pair.rate)];
  return rates;
}

void check_jumps(const Channel& state, const Channel* rate, const std::vector<Channel>& actions, Problems& problems) {
  const auto [beyond, allowed] = changes_of(state, rate);
  if (beyond.size() < 8) return;
  const double usual = usual_change(beyond);
  std::optional<std::vector<std::vector<double>>> pushes;  // where there is a jump
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    const double around = usual_around(beyond, static_cast<std::ptrdiff_t>(i));
    const double bound = std::max({allowed[i], kOutlier * usual, kOutlier * around});
    if (beyond[i] <= bound) continue;
    const double times = beyond[i] / std::max(usual, around);
    if (!pushes) pushes = deviations_of(actions, state);
    if (std::ranges::any_of(*pushes, [&](const auto& sizes) { return is_push(sizes, i, times); })) continue;
    const Sample &before = state.samples[i], &after = state.samples[i + 1];
    problems.add(
        after.row, "jump of " + state.name,
        fmt::format("{} jumps from {:.6g} to {:.6g}{} in {:.6g} s, by more than the {:.3g} that are plausible",
                    state.name, before.value, after.value, unit_text(state.unit), after.time_s - before.time_s, bound));
  }
}

void compare_with_rate(const Channel& state, const Channel& rate, double dt_s, std::vector<std::string>& notes) {
  Vector expected(std::ssize(state.samples) - 1), changes(expected.size());
  for (std::size_t i = 1; i < state.samples.size(); ++i) {
    const auto step = static_cast<Index>(i) - 1;
    expected(step) = expected_change(state, rate, i);
    changes(step) = state.samples[i].value - state.samples[i - 1].value;
  }
  if (std::string note = note_on_rate(state.name, rate.name, expected, changes); !note.empty())
    notes.push_back(std::move(note));
  else if (const double late_s = lateness_of(state, rate); late_s >= kMuchLate * dt_s)
    notes.push_back(
        fmt::format("{} is about {:.2g} s late: {} changes as it says so much later. Speeds from encoders often are "
                    "(docs/recordings.md)",
                    rate.name, late_s, state.name));
}

void look_for_turns(const Channel& angle, std::vector<std::string>& notes) {
  double largest = 0;
  for (std::size_t i = 1; i < angle.samples.size(); ++i)
    largest = std::max(largest, std::abs(angle.samples[i].value - angle.samples[i - 1].value));
  if (largest <= kTurn / 2) return;
  notes.push_back(fmt::format(
      "{} changes by up to {:.3g} rad from row to row, more than half a turn: is it in degrees (then its column is "
      "\"{} [deg]\"), or do rows lie too far apart?",
      angle.name, largest, angle.name));
}

}  // namespace rehearse::recording
