#include "rehearse/study/summary.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/identification/identifiability.hpp"

namespace rehearse::study {
namespace {

using Lines = std::vector<std::string>;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

Lines logs(const Study& study, const Problem& problem) {
  Lines lines;
  const double all_s = static_cast<double>(study.model.all_rows) * problem.task.dt_s;
  lines.push_back(fmt::format("{} logs, {:.4g} s in {} control steps of {} s", problem.logs.size(), all_s,
                              study.model.all_rows, problem.task.dt_s));
  if (study.model.data.size() < study.model.all_rows)
    lines.push_back(
        fmt::format("GPs and parameters learn from {} steps in stretches of a second, evenly spread; {} are "
                    "left out (--set rows=N)",
                    study.model.data.size(), study.model.all_rows - study.model.data.size()));
  for (std::size_t i = 0; i < problem.logs.size(); ++i)
    for (std::size_t s = 0; s < problem.task.states.size(); ++s) {
      const double offset = study.model.zeros.offsets(static_cast<Index>(i), static_cast<Index>(s));
      if (offset != 0)
        lines.push_back(fmt::format("{}: {:+.3g} {} are added to {}", problem.logs[i].name, offset,
                                    problem.task.states[s].unit, problem.task.states[s].name));
    }
  return lines;
}

std::string interval_of(const LogModel& model, std::size_t continuous) {
  if (!model.learned.posterior) return "unknown";
  const Interval interval = model.learned.posterior->intervals()[continuous];
  return fmt::format("{:.4g} to {:.4g}", interval.low, interval.high);
}

/// Parameters that are not at an end of their boxes, where they would predict best: because errors are large, and tell
/// little. Then a box may be the reason.
Lines ends(const Zeros& zeros, const ParameterSpace& space) {
  Lines lines;
  for (const Index i : space.of_kind(Parameter::Kind::continuous)) {
    const auto end = identification::end_at(space[i], zeros.closest_phi(i));
    if (end && !identification::end_at(space[i], zeros.phi(i)))
      lines.push_back(fmt::format("{} would predict best at the end of its box, {:.3g}: a better value may lie beyond",
                                  space[i].name, *end));
  }
  return lines;
}

/// Whether all models' intervals of a parameter have a value in common.
bool agree(const std::vector<LogModel>& models, std::size_t continuous) {
  double low = -INFINITY, high = INFINITY;
  for (const LogModel& model : models) {
    if (!model.learned.posterior) return true;
    const Interval interval = model.learned.posterior->intervals()[continuous];
    low = std::max(low, interval.low), high = std::min(high, interval.high);
  }
  return low <= high;
}

Lines parameters(const Study& study, const Problem& problem) {
  Lines lines;
  std::size_t continuous = 0;
  for (Index i = 0; i < problem.prior.space.size(); ++i) {
    const Parameter& parameter = problem.prior.space[i];
    if (!parameter.tunable()) continue;
    const double value = (*study.model.learned.state.phi)(i);
    if (parameter.kind == Parameter::Kind::discrete) {
      lines.push_back(fmt::format("{} = {:.4g} (guess: {:.4g})", with_unit(parameter.name, parameter.unit), value,
                                  parameter.value));
      continue;
    }
    std::string line = fmt::format("{} = {:.4g}, 95 %: {} (guess: {:.4g})", with_unit(parameter.name, parameter.unit),
                                   value, interval_of(study.model, continuous), parameter.value);
    for (std::size_t m = 0; m < study.without.size(); ++m)
      line += fmt::format("{} without {}: {}", m == 0 ? ";" : ",", study.left_out[m],
                          interval_of(study.without[m], continuous));
    line += agree(study.without, continuous) ? "; all overlap" : ": these do not overlap";
    lines.push_back(line);
    ++continuous;
  }
  if (lines.empty()) lines.emplace_back("the prior tunes none");
  if (study.model.learned.posterior)
    for (const std::string& warning : identification::identifiability_warnings(*study.model.learned.posterior))
      lines.push_back(warning);
  for (const std::string& line : ends(study.model.zeros, problem.prior.space)) lines.push_back(line);
  if (problem.logs.size() > study.left_out.size())
    lines.push_back(
        fmt::format("left out in turn are the first {} of {} logs", study.left_out.size(), problem.logs.size()));
  return lines;
}

Lines steps(const Study& study, const Problem& problem) {
  Lines lines;
  const Vector& noise = study.model.learned.model->measurement_std();
  const StepErrors& of = study.steps;
  for (std::size_t i = 0; i < problem.task.states.size(); ++i) {
    const auto s = static_cast<Index>(i);
    std::string line = fmt::format(
        "{}: a step changes it by {:.3g} (rms); the prior as given leaves {:.3g}, with what was "
        "learned of its parameters {:.3g}",
        with_unit(problem.task.states[i].name, problem.task.states[i].unit), of.change(s), of.prior_as_given(s),
        of.prior(s));
    if (study.gps_worsen || study.beyond != Beyond::nothing) line += fmt::format(", with the GPs {:.3g}", of.model(s));
    if (s < noise.size()) line += fmt::format("; errors of measurements: {:.3g}", noise(s));
    lines.push_back(line);
  }
  if (study.gps_worsen)
    lines.push_back(
        fmt::format("forecasts of logs left out have {:.2f} times the errors with GPs, which are {}used for "
                    "forecasts",
                    *study.gps_worsen, study.beyond == Beyond::gp ? "" : "not "));
  return lines;
}

Lines forecasts(const Study& study, const Problem& problem, const Tested& tested) {
  Lines lines;
  for (std::size_t h = 0; h < study.horizons_s.size(); ++h)
    for (std::size_t i = 0; i < problem.task.states.size(); ++i) {
      const auto row = static_cast<Index>(h), s = static_cast<Index>(i);
      if (!std::isfinite(tested.of_model.rms(row, s))) continue;
      const double model = tested.of_model.rms(row, s), prior = tested.of_prior.rms(row, s);
      lines.push_back(
          fmt::format("{:.3g} s ahead, {}: off by {:.3g} (rms), the prior as given by {:.3g} ({:.2f} times); "
                      "{:.1f} % of what was measured is inside the 95 % band",
                      study.horizons_s[h], with_unit(problem.task.states[i].name, problem.task.states[i].unit), model,
                      prior, model / prior, 100 * tested.of_model.covered(row, s)));
    }
  if (lines.empty()) lines.emplace_back("no log is long enough");
  return lines;
}

}  // namespace

std::vector<Paragraph> summary(const Study& study, const Problem& problem) {
  std::vector<Paragraph> all = {
      {"Logs", logs(study, problem)}, {"Parameters", parameters(study, problem)}, {"One step", steps(study, problem)}};
  if (!study.held_out.logs.empty()) all.push_back({"Held-out logs", forecasts(study, problem, study.held_out)});
  all.push_back({"Logs left out in turn, which calibrate the bands", forecasts(study, problem, study.left_out_logs)});
  return all;
}

}  // namespace rehearse::study
