#include "rehearse/report/prediction_gap.hpp"

#include <cmath>

namespace rehearse::report {
namespace {

using Numbers = std::vector<std::optional<double>>;

constexpr std::string_view kMomentMean = " moment mean";

/// A variable of a prediction: its columns are called NAME PART UNIT.
struct Variable {
  std::string name, unit;  // unit: " [m]", or nothing

  Numbers column(const files::Table& table, const char* part) const { return table.numbers(name + part + unit); }
};

/// The variables that moment matching predicts, the reward among them.
std::vector<Variable> variables(const files::Table& table) {
  std::vector<Variable> found;
  for (const std::string& header : table.header)
    if (const std::size_t end = header.find(kMomentMean); end != std::string::npos)
      found.push_back({header.substr(0, end), header.substr(end + kMomentMean.size())});
  return found;
}

struct Gap {
  double apart = 0, time_s = 0;  // of means, in deviations of the samples: the largest
  std::string state;
  double log_ratios = 0;  // of deviations, summed
  int compared = 0;
};

/// Compares a state at all times where the samples differ: a start that is known exactly has no deviation.
void compare(const files::Table& table, const Variable& state, const Numbers& times, Gap& gap) {
  const Numbers mean = state.column(table, " mean"), deviation = state.column(table, " std");
  const Numbers other = state.column(table, " moment mean"), other_deviation = state.column(table, " moment std");
  for (std::size_t t = 0; t < times.size(); ++t) {
    if (!times[t] || !mean[t] || !deviation[t] || !other[t] || !other_deviation[t]) continue;
    if (*deviation[t] <= 0 || *other_deviation[t] <= 0) continue;
    const double apart = std::abs(*other[t] - *mean[t]) / *deviation[t];
    if (apart > gap.apart) gap.apart = apart, gap.time_s = *times[t], gap.state = state.name;
    gap.log_ratios += std::log(*other_deviation[t] / *deviation[t]);
    ++gap.compared;
  }
}

/// The total reward of all steps; null if one is not known.
Json total(const Numbers& rewards) {
  double sum = 0;
  for (std::size_t t = 1; t < rewards.size(); ++t) {
    if (!rewards[t]) return {};
    sum += *rewards[t];
  }
  return rounded(sum);
}

}  // namespace

Json prediction_gap(const files::Table& prediction) {
  const std::vector<Variable> all = variables(prediction);
  if (all.empty()) return {};
  const Numbers times = prediction.numbers("time [s]");
  const Variable reward{.name = "reward", .unit = ""};
  Gap gap;
  for (const Variable& variable : all)
    if (variable.name != reward.name) compare(prediction, variable, times, gap);
  Json json = {{"sampled_return", total(reward.column(prediction, " mean"))},
               {"moment_return", total(reward.column(prediction, " moment mean"))}};
  if (gap.compared == 0) return json;
  json["apart"] = rounded(gap.apart);
  json["state"] = gap.state;
  json["time_s"] = rounded(gap.time_s);
  json["spread"] = rounded(std::exp(gap.log_ratios / gap.compared));
  return json;
}

}  // namespace rehearse::report
