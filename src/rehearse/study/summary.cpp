#include "rehearse/study/summary.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/core/text_table.hpp"
#include "rehearse/study/warnings.hpp"

namespace rehearse::study {
namespace {

using Lines = std::vector<std::string>;

bool has_gps(const Study& study) { return study.gps_worsen || study.beyond != Beyond::nothing; }

Section logs(const Study& study, const Problem& problem) {
  Lines lines;
  const double all_s = static_cast<double>(study.model.all_rows) * problem.task.dt_s;
  lines.push_back(fmt::format("{} log{}, {:.4g} s in {} control steps of {} s", problem.logs.size(),
                              problem.logs.size() == 1 ? "" : "s", all_s, study.model.all_rows, problem.task.dt_s));
  if (has_gps(study) && study.model.data.size() < study.model.all_rows)
    lines.push_back(fmt::format(
        "{} learn from {} steps in stretches of a second at most, evenly spread; {} are left out (--set rows=N)",
        study.beyond == Beyond::gp_mi ? "GPs and parameters" : "GPs", study.model.data.size(),
        study.model.all_rows - study.model.data.size()));
  for (std::size_t i = 0; i < problem.logs.size(); ++i)
    for (std::size_t s = 0; s < problem.task.states.size(); ++s) {
      const double offset = study.model.zeros.offsets(static_cast<Index>(i), static_cast<Index>(s));
      if (offset != 0)
        lines.push_back(fmt::format("{}: {:+.3g} {} are added to {}", problem.logs[i].name, offset,
                                    problem.task.states[s].unit, problem.task.states[s].name));
    }
  for (std::string& line : log_warnings(study, problem.task)) lines.push_back(std::move(line));
  for (const std::string& note : study.model.learned.notes) lines.push_back(note);
  return {"Logs", {}, lines};
}

std::string interval_of(const LogModel& model, std::size_t continuous) {
  const std::vector<Interval> intervals = intervals_of(model);
  if (intervals.empty()) return moves(model) ? "unknown" : "nothing moves";
  return fmt::format("{:.4g} to {:.4g}", intervals[continuous].low, intervals[continuous].high);
}

Section parameters(const Study& study, const Problem& problem) {
  Section section{.title = "Parameters", .table = {{"parameter", "value", "guess", "95 %"}}, .notes = {}};
  for (const std::string& log : study.left_out_logs.logs) section.table.front().push_back("without " + log);
  std::size_t continuous = 0;
  for (Index i = 0; i < problem.prior.space.size(); ++i) {
    const Parameter& parameter = problem.prior.space[i];
    if (!parameter.tunable()) continue;
    Lines row = {with_unit(parameter.name, parameter.unit), fmt::format("{:.4g}", (*study.model.learned.state.phi)(i)),
                 fmt::format("{:.4g}", parameter.value)};
    if (parameter.kind == Parameter::Kind::continuous) {
      row.push_back(interval_of(study.model, continuous));
      for (const LogModel& without : study.without) row.push_back(interval_of(without, continuous));
      ++continuous;
    }
    section.table.push_back(row);
  }
  if (section.table.size() == 1) return {section.title, {}, {"the prior tunes none"}};
  section.notes = parameter_warnings(study, problem);
  if (problem.logs.size() > study.left_out_logs.logs.size())
    section.notes.push_back(fmt::format("left out in turn are the first {} of {} logs", study.left_out_logs.logs.size(),
                                        problem.logs.size()));
  return section;
}

Section steps(const Study& study, const Problem& problem) {
  const Vector& noise = study.model.learned.model->measurement_std();
  const StepErrors& of = study.steps;
  Section section{
      .title = "What a control step changes, and what is left of it unexplained (rms)", .table = {}, .notes = {}};
  section.table.push_back({"state", "change", "prior as given", "with its parameters learned"});
  if (has_gps(study)) section.table.front().emplace_back("with the GPs");
  if (noise.size() > 0) section.table.front().emplace_back("errors of measurements");
  for (std::size_t i = 0; i < problem.task.states.size(); ++i) {
    const auto s = static_cast<Index>(i);
    Lines row = {with_unit(problem.task.states[i].name, problem.task.states[i].unit)};
    std::vector<double> numbers = {of.change(s), of.prior_as_given(s), of.prior(s)};
    if (has_gps(study)) numbers.push_back(of.model(s));
    if (s < noise.size()) numbers.push_back(noise(s));
    for (const double number : numbers) row.push_back(fmt::format("{:.3g}", number));
    section.table.push_back(row);
  }
  if (study.gps_worsen)
    section.notes.push_back(
        fmt::format("with GPs, forecasts of logs left out have {:.2f} times the errors, so GPs are {}used",
                    *study.gps_worsen, study.beyond == Beyond::gp ? "" : "not "));
  return section;
}

Section forecasts(const Study& study, const Problem& problem, const Tested& tested, const std::string& title) {
  Section section{.title = title + ": how far forecasts are off (rms)", .table = {}, .notes = {}};
  section.table.push_back({"ahead", "state", "model", "prior as given", "ratio", "inside the 95 % band"});
  for (std::size_t h = 0; h < study.horizons_s.size(); ++h)
    for (std::size_t i = 0; i < problem.task.states.size(); ++i) {
      const auto row = static_cast<Index>(h), s = static_cast<Index>(i);
      if (!std::isfinite(tested.of_model.rms(row, s))) continue;
      const double model = tested.of_model.rms(row, s), prior = tested.of_prior.rms(row, s);
      section.table.push_back({fmt::format("{:.3g} s", study.horizons_s[h]),
                               with_unit(problem.task.states[i].name, problem.task.states[i].unit),
                               fmt::format("{:.3g}", model), fmt::format("{:.3g}", prior),
                               prior > 0 ? fmt::format("{:.2f}", model / prior) : "",
                               fmt::format("{:.1f} %", 100 * tested.of_model.covered(row, s))});
    }
  if (section.table.size() == 1) return {title, {}, {"no log is long enough"}};
  return section;
}

}  // namespace

std::vector<Section> summary(const Study& study, const Problem& problem) {
  std::vector<Section> all = {logs(study, problem), parameters(study, problem), steps(study, problem)};
  if (!study.held_out.logs.empty()) all.push_back(forecasts(study, problem, study.held_out, "Held-out logs"));
  all.push_back(forecasts(study, problem, study.left_out_logs, "Logs left out in turn, which calibrate the bands"));
  return all;
}

std::vector<std::string> lines_of(const Section& section) {
  Lines lines = aligned(section.table);
  lines.insert(lines.end(), section.notes.begin(), section.notes.end());
  return lines;
}

}  // namespace rehearse::study
