#include "rehearse/study/tables.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/files/csv.hpp"
#include "rehearse/study/warnings.hpp"

namespace rehearse::study {
namespace {

using Row = std::vector<std::string>;
using files::Csv;

/// Value and interval of a parameter of a model.
void add_parameter(Row& row, const LogModel& model, Index parameter, Index continuous) {
  row.push_back(Csv::cell(double{(*model.learned.state.phi)(parameter)}));
  const std::vector<Interval> intervals = intervals_of(model);
  const bool known = continuous >= 0 && !intervals.empty();
  row.push_back(known ? Csv::cell(intervals[static_cast<std::size_t>(continuous)].low) : "");
  row.push_back(known ? Csv::cell(intervals[static_cast<std::size_t>(continuous)].high) : "");
}

std::string parameters_csv(const Study& study, const Problem& problem) {
  Row header = {"parameter", "unit", "prior", "box.low", "box.high", "value", "low", "high"};
  for (const std::string& name : study.left_out_logs.logs)
    for (const char* what : {"value", "low", "high"}) header.push_back(fmt::format("{} without {}", what, name));
  Csv csv(header);
  Index continuous = 0;
  for (Index i = 0; i < problem.prior.space.size(); ++i) {
    const Parameter& parameter = problem.prior.space[i];
    if (!parameter.tunable()) continue;
    const bool boxed = parameter.kind == Parameter::Kind::continuous;
    Row row = {parameter.name, parameter.unit, Csv::cell(parameter.value), boxed ? Csv::cell(parameter.box.low) : "",
               boxed ? Csv::cell(parameter.box.high) : ""};
    const Index number = boxed ? continuous++ : -1;
    add_parameter(row, study.model, i, number);
    for (const LogModel& model : study.without) add_parameter(row, model, i, number);
    csv.row(row);
  }
  return csv.text();
}

std::string zeros_csv(const Study& study, const Problem& problem) {
  Row header = {"log", "set"};
  for (const StateVariable& state : problem.task.states) header.push_back(with_unit(state.name, state.unit));
  Csv csv(header);
  const auto add = [&](const std::string& log, const std::string& set, const Vector& offset) {
    Row row = {log, set};
    for (const double o : offset) row.push_back(Csv::cell(o));
    csv.row(row);
  };
  for (std::size_t i = 0; i < problem.logs.size(); ++i)
    add(problem.logs[i].name, "learned from", study.model.zeros.offsets.row(static_cast<Index>(i)).transpose());
  for (const auto& [tested, set] : {std::pair{&study.left_out_logs, "left out"}, {&study.held_out, "held out"}})
    for (std::size_t i = 0; i < tested->logs.size(); ++i) add(tested->logs[i], set, tested->offsets[i]);
  return csv.text();
}

std::string accuracy_csv(const Study& study, const Problem& problem) {
  Csv csv({"set", "horizon [s]", "state", "unit", "compared", "rms error", "rms error of the prior as given",
           "inside the 95 % band", "calibration"});
  for (const auto& [tested, set] : {std::pair{&study.left_out_logs, "left out"}, {&study.held_out, "held out"}})
    for (std::size_t h = 0; h < study.horizons_s.size() && !tested->logs.empty(); ++h)
      for (std::size_t s = 0; s < problem.task.states.size(); ++s) {
        const auto row = static_cast<Index>(h), state = static_cast<Index>(s);
        csv.row({set, Csv::cell(study.horizons_s[h]), problem.task.states[s].name, problem.task.states[s].unit,
                 Csv::cell(Index{tested->of_model.compared(row, state)}),
                 Csv::cell(double{tested->of_model.rms(row, state)}),
                 Csv::cell(double{tested->of_prior.rms(row, state)}),
                 Csv::cell(double{tested->of_model.covered(row, state)}),
                 Csv::cell(double{study.calibration(row, state)})});
      }
  return csv.text();
}

std::string steps_csv(const Study& study, const Problem& problem) {
  Csv csv({"state", "unit", "rms change", "rms left by the prior as given", "rms left by the prior",
           "rms left by the model", "noise of measurements"});
  const Vector& noise = study.model.learned.model->measurement_std();
  for (std::size_t i = 0; i < problem.task.states.size(); ++i) {
    const auto s = static_cast<Index>(i);
    Row row = {problem.task.states[i].name, problem.task.states[i].unit};
    for (const Vector* numbers :
         {&study.steps.change, &study.steps.prior_as_given, &study.steps.prior, &study.steps.model})
      row.push_back(Csv::cell(double{(*numbers)(s)}));
    row.push_back(s < noise.size() ? Csv::cell(double{noise(s)}) : "");
    csv.row(row);
  }
  return csv.text();
}

/// Measured, predicted and the band, by the time that is predicted, as the log has its states.
std::string forecast_csv(const Study& study, const Task& task, const Forecasts& forecasts, const Vector& offset,
                         std::size_t h) {
  Row header = {"time [s]"};
  for (const StateVariable& state : task.states)
    for (const char* what : {"{}", "{} predicted", "{} low", "{} high"})
      header.push_back(with_unit(fmt::format(fmt::runtime(what), state.name), state.unit));
  Csv csv(header);
  const Forecasts::At& at = forecasts.at[h];
  for (Index i = 0; i < at.predicted.rows(); ++i) {
    if (!at.measured.row(i).allFinite()) continue;
    const Index step = forecasts.starts[static_cast<std::size_t>(i)] + forecasts.horizons[h];
    Row row = {Csv::cell(seconds(step, task.dt_s))};
    for (Index s = 0; s < at.predicted.cols(); ++s) {
      const double mean = at.predicted(i, s) - offset(s);
      const double half = study.half_band(h, s, at.deviation(i, s));
      for (const double number : {at.measured(i, s) - offset(s), mean, mean - half, mean + half})
        row.push_back(Csv::cell(number));
    }
    csv.row(row);
  }
  return csv.text();
}

std::string warnings_csv(const Study& study, const Problem& problem) {
  Csv csv({"kind", "text"});
  for (const std::string& line : parameter_warnings(study, problem)) csv.row({"parameters", line});
  for (const std::string& line : log_warnings(study, problem.task)) csv.row({"logs", line});
  for (const std::string& line : study.model.learned.notes) csv.row({"model", line});
  return csv.text();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> csv_files(const Study& study, const Problem& problem) {
  std::vector<std::pair<std::string, std::string>> all = {{"parameters.csv", parameters_csv(study, problem)},
                                                          {"zeros.csv", zeros_csv(study, problem)},
                                                          {"accuracy.csv", accuracy_csv(study, problem)},
                                                          {"steps.csv", steps_csv(study, problem)},
                                                          {"warnings.csv", warnings_csv(study, problem)}};
  const Tested& tested = study.held_out.logs.empty() ? study.left_out_logs : study.held_out;
  for (std::size_t i = 0; i < tested.logs.size(); ++i)
    for (std::size_t h = 0; h < study.horizons_s.size(); ++h)
      all.emplace_back(fmt::format("forecasts-{}-{}s.csv", i + 1, study.horizons_s[h]),
                       forecast_csv(study, problem.task, tested.model[i], tested.offsets[i], h));
  return all;
}

}  // namespace rehearse::study
