#include "rehearse/experiment/robustness.hpp"

#include <utility>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/files/csv.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::experiment {
namespace {

const std::string kPlant = "scenario.plant.";  // the beginning of the options that are the robot's parameters

struct Value {
  std::string parameter;
  double value;
};

/// The robot's parameters that a factor changes.
std::vector<Value> parameters_of(const Resolved& run) {
  std::vector<Value> all;
  const auto add = [&all](const std::string& name, double value) {
    if (value != 0) all.push_back({name, value});
  };
  if (const prior::Prior* prior = run.stand_in()) {
    for (const Parameter& parameter : prior->space.all())
      if (parameter.kind != Parameter::Kind::discrete) add(parameter.name, parameter.value);
  } else {
    for (const auto& [key, text] : run.spec.options)
      if (double value = 0; key.starts_with(kPlant) && from_text(text, value)) add(key.substr(kPlant.size()), value);
  }
  if (all.empty())
    throw InvalidInput(fmt::format("scenario {} has no parameter {}.NAME that could be changed", run.spec.scenario,
                                   run.stand_in() ? "prior" : "plant"));
  return all;
}

/// The run whose prior, which plays the robot, has another value of a parameter: bounds of learning do not hold here.
Resolved with_prior_at(Resolved run, const std::string& parameter, double value) {
  ParameterSpace& space = run.prior->space;
  Vector phi = space.values();
  phi(space.find(parameter)) = value;
  space = space.fixed_at(phi);
  return run;
}

/// The robot; none where the value is beyond the bounds of its option.
std::optional<Resolved> within_bounds(const std::function<Resolved()>& make) try {
  return make();
} catch (const InvalidInput&) {
  return std::nullopt;
}

/// The episodes of a changed robot, which may fail.
void evaluate_changed(Changed& changed, const Resolved& robot, const Learned& learned, const EvaluationPlan& plan,
                      const Evaluator& evaluator) try {
  changed.summary = summary_of(evaluate(robot, learned, plan, evaluator));
} catch (const RunFailed& error) {
  changed.failure = error.what();
}

void add_rate(std::vector<std::string>& row, const std::optional<statistics::Rate>& rate) {
  using files::Csv;
  if (!rate) return row.resize(row.size() + 3);
  row.insert(row.end(), {Csv::cell(rate->value()), Csv::cell(rate->interval.low), Csv::cell(rate->interval.high)});
}

}  // namespace

std::vector<Changed> robustness(const std::function<Resolved(const std::string& key, const std::string& value)>& make,
                                const Resolved& run, const Learned& learned, const EvaluationPlan& plan,
                                const Evaluator& evaluator) {
  std::vector<Changed> all;
  std::vector<std::optional<Resolved>> robots;  // before the first episode: a value that is refused costs no time
  for (const auto& [parameter, value] : parameters_of(run))
    for (const double factor : kFactors) {
      const double changed = factor * value;
      std::optional<Resolved> robot;  // none: as it is
      if (factor != 1) {
        if (run.stand_in())
          robot = with_prior_at(run, parameter, changed);
        else if (robot = within_bounds([&] { return make(kPlant + parameter, fmt::format("{}", changed)); }); !robot)
          continue;
      }
      all.push_back({parameter, factor, changed, {}});
      robots.push_back(std::move(robot));
    }
  const Summary unchanged = summary_of(evaluate(run, learned, plan, evaluator));
  for (std::size_t i = 0; i < all.size(); ++i)
    if (robots[i])
      evaluate_changed(all[i], *robots[i], learned, plan, evaluator);
    else
      all[i].summary = unchanged;
  return all;
}

std::vector<std::string> robustness_failures(const std::vector<Changed>& all) {
  std::vector<std::string> lines;
  for (const Changed& each : all)
    if (!each.failure.empty()) lines.push_back(fmt::format("{} {:.4g}: {}", each.parameter, each.value, each.failure));
  return lines;
}

std::string robustness_csv(const std::vector<Changed>& all, const EvaluationAbout& about) {
  using files::Csv;
  std::vector<std::string> header = kAboutColumns;
  header.insert(header.end(),
                {"parameter", "factor", "value", "episodes", "solved", "solved_low", "solved_high", "solved_at_end",
                 "solved_at_end_low", "solved_at_end_high", "ended", "return_25", "return_50", "return_75"});
  Csv csv(header);
  for (const auto& [parameter, factor, value, summary, failure] : all) {
    if (!failure.empty()) continue;
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
