#include "rehearse/experiment/robustness.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/files/csv.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::experiment {
namespace {

/// The beginning of the options that are the robot's parameters.
std::string group_of(const Resolved& run) { return run.stand_in() ? "prior." : "scenario.plant."; }

struct Value {
  std::string parameter;
  double value;
};

/// The robot's parameters that a factor changes.
std::vector<Value> parameters_of(const Spec& complete, const std::string& group) {
  std::vector<Value> all;
  for (const auto& [key, text] : complete.options) {
    double value = 0;
    if (key.starts_with(group) && from_text(text, value) && value != 0)
      all.push_back({key.substr(group.size()), value});
  }
  if (all.empty())
    throw InvalidInput(
        fmt::format("scenario {} has no parameter {}NAME that could be changed", complete.scenario, group));
  return all;
}

void add_rate(std::vector<std::string>& row, const std::optional<Rate>& rate) {
  using files::Csv;
  if (!rate) return row.resize(row.size() + 3);
  row.insert(row.end(), {Csv::cell(rate->value()), Csv::cell(rate->interval.low), Csv::cell(rate->interval.high)});
}

}  // namespace

std::vector<Changed> robustness(const std::function<Resolved(const std::string& key, const std::string& value)>& make,
                                const Resolved& run, const Learned& learned, const EvaluationPlan& plan,
                                const Evaluator& evaluator) {
  const std::string group = group_of(run);
  const std::vector<Value> parameters = parameters_of(run.spec, group);
  const Summary unchanged = summary_of(evaluate(run, learned, plan, evaluator));
  std::vector<Changed> all;
  for (const auto& [parameter, value] : parameters)
    for (const double factor : kFactors) {
      const double changed = factor * value;
      all.push_back({parameter, factor, changed, unchanged});
      if (factor == 1) continue;
      const Resolved other = make(group + parameter, fmt::format("{}", changed));
      all.back().summary = summary_of(evaluate(other, learned, plan, evaluator));
    }
  return all;
}

std::string robustness_csv(const std::vector<Changed>& all, const EvaluationAbout& about) {
  using files::Csv;
  std::vector<std::string> header = kAboutColumns;
  header.insert(header.end(),
                {"parameter", "factor", "value", "episodes", "solved", "solved_low", "solved_high", "solved_at_end",
                 "solved_at_end_low", "solved_at_end_high", "ended", "return_25", "return_50", "return_75"});
  Csv csv(header);
  for (const auto& [parameter, factor, value, summary] : all) {
    std::vector<std::string> row = about_cells(about);
    row.insert(row.end(), {parameter, Csv::cell(factor), Csv::cell(value), Csv::cell(summary.ended.of)});
    add_rate(row, summary.solved);
    add_rate(row, summary.solved_at_end);
    const auto [min, low, median, high, max] = statistics::five_numbers(summary.returns);
    for (const double number : {summary.ended.value(), low, median, high}) row.push_back(Csv::cell(number));
    csv.row(row);
  }
  return csv.text();
}

}  // namespace rehearse::experiment
