#include "rehearse/recording/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/episode_fit.hpp"
#include "rehearse/core/name_list.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/recording/units.hpp"

namespace rehearse::recording {
namespace {

constexpr double kLatest = 1e19;  // of a time: nanoseconds since 1970

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// "q1 [rad]" or "q1 (rad)".
struct Title {
  std::string name, unit;

  bool is_number() const {
    double value = 0;
    return from_text(name, value);
  }
};

Title title_of(const std::string& cell) {
  const std::string text = trimmed(cell);
  for (const auto& [opening, closing] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const auto begin = text.find_last_of(opening);
    if (begin != std::string::npos && begin > 0 && text.back() == closing)
      return {trimmed(text.substr(0, begin)), trimmed(text.substr(begin + 1, text.size() - begin - 2))};
  }
  return {text, ""};
}

/// "1,5"
bool has_decimal_comma(std::string cell) {
  const auto comma = cell.find(',');
  if (comma == std::string::npos) return false;
  cell[comma] = '.';
  double value = 0;
  return from_text(cell, value);
}

class Finder {
 public:
  Finder(const files::Table& table, const Task& task, Problems& problems, std::vector<std::string>& notes)
      : table_(table), problems_(problems), notes_(notes) {
    for (const std::string& cell : table.header) titles_.push_back(title_of(cell));
    for (const StateVariable& state : task.states) wanted_.insert(state.name);
    for (const ActionVariable& action : task.actions) wanted_.insert(action.name);
    if (has_no_header()) problems_.add(1, "header", "it has numbers, must have the names of columns");
  }

  /// The column of the time.
  Title find_times() {
    const std::string name = name_of_time();
    const int column = require(name);
    const double scale = column < 0 ? 1 : scale_of(column, "time", "s");
    for (std::size_t row = 0; column >= 0 && row < table_.rows.size(); ++row) {
      const auto value = number(row, column, name, kLatest);
      if (is_empty(row, column)) problems_.add(in_file(row), "no time", "there is no time");
      const double before = times_.empty() ? 0 : times_.back();
      if (value && row > 0) check_order(row, *value * scale);
      times_.push_back(value ? *value * scale : before);  // one that cannot be read is no further problem
    }
    return column < 0 ? Title{name, ""} : titles_[static_cast<std::size_t>(column)];
  }

  Channel channel(const std::string& name, const std::string& unit) {
    Channel channel{name, unit, {}};
    const int column = require(name);
    if (column < 0) return channel;
    const double scale = scale_of(column, name, unit);
    for (std::size_t row = 0; row < times_.size(); ++row) {
      const auto value = number(row, column, name);
      if (value && times_[row] >= 0) channel.samples.push_back({times_[row], *value * scale, in_file(row)});
    }
    if (channel.samples.empty() && !times_.empty())
      problems_.add(0, "none of " + name, fmt::format("{} has no number at a time ≥ 0", name));
    return channel;
  }

  bool has(const std::string& name) const { return std::ranges::find(titles_, name, &Title::name) != titles_.end(); }

  void note_others() {
    if (!converted_.empty()) notes_.push_back(fmt::format("converted: {}", fmt::join(converted_, ", ")));
    const auto before = std::ranges::count_if(times_, [](double t) { return t < 0; });
    if (before > 0) notes_.push_back(fmt::format("{} rows before time 0 are left out", before));
    std::vector<std::string> others;
    for (const Title& title : titles_)
      if (!title.name.empty() && !wanted_.contains(title.name) && title.name != "reward" &&
          !title.name.starts_with("true "))
        others.push_back(title.name);
    if (!others.empty()) notes_.push_back(fmt::format("columns that are not used: {}", fmt::join(others, ", ")));
  }

 private:
  /// "time", else as anyone spells it, else "t", else "T"; none that the task has for something else.
  std::string name_of_time() {
    std::array<std::set<std::string>, 4> ranks;
    for (const auto& [name, unit] : titles_) {
      if (wanted_.contains(name)) continue;
      if (in_lower_case(name) == "time") ranks[name == "time" ? 0 : 1].insert(name);
      if (in_lower_case(name) == "t") ranks[name == "t" ? 2 : 3].insert(name);
    }
    const auto best = std::ranges::find_if_not(ranks, &std::set<std::string>::empty);
    if (best == ranks.end()) return "time";
    if (best->size() > 1)
      problems_.add(1, "two times",
                    fmt::format("the columns {} are all the time, must be one", fmt::join(*best, ", ")));
    return *best->begin();
  }

  static Index in_file(std::size_t row) { return static_cast<Index>(row) + 2; }

  bool has_no_header() const { return std::ranges::all_of(titles_, &Title::is_number); }

  /// −1: it is not there, which is a problem.
  int require(const std::string& name) {
    wanted_.insert(name);
    if (has_no_header()) return -1;  // one problem tells it all
    const auto count = std::ranges::count(titles_, name, &Title::name);
    const auto at = std::ranges::find(titles_, name, &Title::name) - titles_.begin();
    if (count == 1) return static_cast<int>(at);
    if (count > 1) problems_.add(1, "twice " + name, fmt::format("there are {} columns {}", count, name));
    if (count == 0) problems_.add(1, "missing " + name, fmt::format("there is no column {}{}", name, others()));
    return -1;
  }

  /// The columns that are nobody's, of which one may be the missing one.
  std::string others() const {
    constexpr std::size_t kMost = 8;
    std::vector<std::string> names;
    for (const Title& title : titles_)
      if (!wanted_.contains(title.name) && !title.name.empty()) names.push_back(title.name);
    return names.empty() ? "" : "; unused columns: " + list_of(names, kMost);
  }

  double scale_of(int column, const std::string& name, const std::string& unit) {
    const std::string& given = titles_[static_cast<std::size_t>(column)].unit;
    if (given.empty()) return 1;
    if (unit.empty()) {
      notes_.push_back(
          fmt::format("{} has no unit in the task, and is taken as the recording has it, in {}", name, given));
      return 1;
    }
    const auto scale = conversion(given, unit);
    if (!scale)
      problems_.add(1, "unit of " + name,
                    fmt::format("{} is in '{}', must be in {}", name, given, fmt::join(units_like(unit), ", ")));
    if (scale && *scale != 1) converted_.push_back(fmt::format("{} from {} to {}", name, given, unit));
    return scale.value_or(1);
  }

  bool is_empty(std::size_t row, int column) const {
    return trimmed(table_.rows[row][static_cast<std::size_t>(column)]).empty();
  }

  std::optional<double> number(std::size_t row, int column, const std::string& name, double largest = kLargestGiven) {
    if (is_empty(row, column)) return std::nullopt;
    const std::string cell = trimmed(table_.rows[row][static_cast<std::size_t>(column)]);
    double value = 0;
    if (!from_text(cell, value) || !std::isfinite(value)) {
      problems_.add(in_file(row), "number in " + name,
                    fmt::format("{} = '{}', must be a finite number{}", name, cell.substr(0, 40),
                                has_decimal_comma(cell) ? ", whose decimals have a point" : ""));
      return std::nullopt;
    }
    if (std::abs(value) > largest) {
      problems_.add(in_file(row), "size of " + name, fmt::format("{} = {}, must be within ± {}", name, value, largest));
      return std::nullopt;
    }
    return value;
  }

  void check_order(std::size_t row, double time_s) {
    if (time_s == times_.back())
      problems_.add(in_file(row), "time twice", fmt::format("time = {} s is that of the row before", time_s));
    if (time_s < times_.back())
      problems_.add(in_file(row), "order of times",
                    fmt::format("time = {} s, must be after the {} s of the row before", time_s, times_.back()));
  }

  const files::Table& table_;
  Problems& problems_;
  std::vector<std::string>& notes_;
  std::vector<Title> titles_;
  std::set<std::string> wanted_;  // names of columns
  std::vector<double> times_;
  std::vector<std::string> converted_;
};

}  // namespace

Channels find_channels(const files::Table& table, const Task& task, Problems& problems,
                       std::vector<std::string>& notes) {
  Finder finder(table, task, problems, notes);
  auto [time, time_unit] = finder.find_times();
  Channels channels{
      .states = {}, .actions = {}, .truths = {}, .time = std::move(time), .time_unit = std::move(time_unit)};
  const std::span own(task.states.data(), static_cast<std::size_t>(task.actuators().own_states()));
  for (const StateVariable& state : own) channels.states.push_back(finder.channel(state.name, state.unit));
  for (const ActionVariable& action : task.actions)
    channels.actions.push_back(finder.channel(action.name, action.unit));
  const bool known = std::ranges::all_of(own, [&](const auto& state) { return finder.has("true " + state.name); });
  if (known)
    for (const StateVariable& state : own) channels.truths.push_back(finder.channel("true " + state.name, state.unit));
  finder.note_others();
  return channels;
}

}  // namespace rehearse::recording
