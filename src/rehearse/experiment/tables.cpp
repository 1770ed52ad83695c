#include "rehearse/experiment/tables.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/files/csv.hpp"
#include "rehearse/statistics/columns.hpp"

namespace rehearse::experiment {
namespace {

using Row = std::vector<std::string>;

/// One column per state, `format` applied to its name.
void add_states(Row& header, const Task& task, const std::string& format) {
  for (const StateVariable& state : task.states)
    header.push_back(with_unit(fmt::format(fmt::runtime(format), state.name), state.unit));
}

template <class RowOfMatrix>
void add_numbers(Row& row, const RowOfMatrix& numbers) {
  for (Index i = 0; i < numbers.size(); ++i) row.push_back(files::Csv::cell(double{numbers(i)}));
}

/// Three cells a parameter: its value and the ends of its interval.
void add_parameters(Row& row, const TrialRecord& trial) {
  for (std::size_t i = 0; i < trial.phi.size(); ++i) {
    row.push_back(files::Csv::cell(trial.phi[i]));
    const auto interval = i < trial.phi_intervals.size() ? trial.phi_intervals[i] : std::nullopt;
    row.push_back(interval ? files::Csv::cell(interval->low) : "");
    row.push_back(interval ? files::Csv::cell(interval->high) : "");
  }
}

/// One row a sentence of a trial.
std::string sentences_csv(const std::vector<TrialRecord>& trials, const char* name,
                          std::vector<std::string> TrialRecord::*sentences) {
  files::Csv csv({"trial", name});
  for (const TrialRecord& trial : trials)
    for (const std::string& sentence : trial.*sentences) csv.row({files::Csv::cell(trial.trial), sentence});
  return csv.text();
}

void add_moments_header(Row& header, const Task& task) {
  for (const std::string format : {"{} std", "{} moment mean", "{} moment std"}) add_states(header, task, format);
  header.insert(header.end(), {"reward mean", "reward std", "reward moment mean", "reward moment std"});
}

/// No reward is earned by the start.
void add_moments(Row& row, const rollout::Recorded& recorded, const ExpectedEpisode& moments, Index t) {
  add_numbers(row, statistics::column_deviations(recorded.states[static_cast<std::size_t>(t)]));
  add_numbers(row, moments.states.row(t));
  add_numbers(row, moments.state_deviations.row(t));
  if (t == 0) return row.resize(row.size() + 4);
  const Matrix rewards = recorded.rewards.col(t - 1);
  add_numbers(row, statistics::column_means(rewards));
  add_numbers(row, statistics::column_deviations(rewards));
  add_numbers(row, Vector{{moments.rewards(t - 1), moments.reward_deviations(t - 1)}});
}

std::optional<Index> as_number(const std::optional<bool>& flag) {
  return flag ? std::optional<Index>(*flag ? 1 : 0) : std::nullopt;
}

}  // namespace

std::vector<std::string> tunable_names(const std::optional<prior::Prior>& prior) {
  std::vector<std::string> names;
  if (!prior) return names;
  for (const Parameter& parameter : prior->space.all())
    if (parameter.tunable()) names.push_back(parameter.name);
  return names;
}

std::string trials_csv(const std::vector<TrialRecord>& trials, const std::vector<std::string>& phi_names,
                       bool evaluated) {
  Row header = {"trial",    "interaction_s",   "return",      "solved", "predicted_return",
                "rollouts", "failed_rollouts", "log_evidence"};
  if (evaluated) header.push_back("expected_return");
  for (const std::string& name : phi_names)
    for (const char* end : {"", ".low", ".high"}) header.push_back("phi." + name + end);
  const std::size_t columns = header.size();
  const bool any_cut_short = std::ranges::any_of(trials, &TrialRecord::cut_short);
  if (any_cut_short) header.push_back("cut_short");
  files::Csv csv(header);
  for (const TrialRecord& t : trials) {
    Row row = {files::Csv::cell(t.trial),
               files::Csv::cell(t.interaction_s),
               files::Csv::cell(t.total_reward),
               files::Csv::cell(as_number(t.solved)),
               files::Csv::cell(t.predicted_return),
               files::Csv::cell(t.rollouts),
               files::Csv::cell(t.failed_rollouts),
               files::Csv::cell(t.log_evidence)};
    if (evaluated) row.push_back(files::Csv::cell(t.expected_return));
    add_parameters(row, t);
    row.resize(columns);
    if (any_cut_short) row.push_back(files::Csv::cell(Index{t.cut_short}));
    csv.row(row);
  }
  return csv.text();
}

std::string timings_csv(const std::vector<TrialRecord>& trials) {
  files::Csv csv({"trial", "model_s", "search_s", "rollouts_per_s"});
  for (const TrialRecord& t : trials) {
    const double per_s = t.search_s > 0 ? static_cast<double>(t.rollouts) / t.search_s : std::nan("");
    csv.row({files::Csv::cell(t.trial), files::Csv::cell(t.model_s), files::Csv::cell(t.search_s),
             files::Csv::cell(per_s)});
  }
  return csv.text();
}

std::string errors_csv(const std::vector<TrialRecord>& trials, const Task& task) {
  Row header = {"trial", "horizon", "compared", "failed"};
  add_states(header, task, "rms {}");
  files::Csv csv(header);
  for (const TrialRecord& t : trials)
    for (const ForecastError& error : t.forecast) {
      Row row = {files::Csv::cell(t.trial), files::Csv::cell(error.horizon), files::Csv::cell(error.compared),
                 files::Csv::cell(error.failed)};
      add_numbers(row, error.rms);
      csv.row(row);
    }
  return csv.text();
}

std::string limits_csv(const std::vector<TrialRecord>& trials) {
  files::Csv csv({"trial", "limit", "allowed_risk", "predicted_risk", "low", "high", "broken"});
  for (const TrialRecord& t : trials)
    for (const LimitRecord& l : t.limits) {
      const auto end = [&](double value) { return l.predicted ? files::Csv::cell(value) : std::string(); };
      csv.row({files::Csv::cell(t.trial), l.limit, files::Csv::cell(l.allowed), files::Csv::cell(l.predicted),
               end(l.interval.low), end(l.interval.high), files::Csv::cell(Index{l.broken})});
    }
  return csv.text();
}

std::string notes_csv(const std::vector<TrialRecord>& trials) {
  return sentences_csv(trials, "note", &TrialRecord::notes);
}

std::string identifiability_csv(const std::vector<TrialRecord>& trials) {
  return sentences_csv(trials, "warning", &TrialRecord::warnings);
}

std::string logs_csv(const std::vector<Log>& logs, const Task& task) {
  files::Csv csv({"log", "file", "steps", "duration_s", "notes"});
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const Index steps = logs[i].episode.steps();
    csv.row({files::Csv::cell(static_cast<Index>(i) + 1), logs[i].name, files::Csv::cell(steps),
             files::Csv::cell(seconds(steps, task.dt_s)), fmt::format("{}", fmt::join(logs[i].notes, "; "))});
  }
  return csv.text();
}

std::string policies_json(const std::vector<TrialRecord>& trials, const Resolved& resolved) {
  const auto entry = [](const TrialRecord& t) {
    return nlohmann::ordered_json{{"trial", t.trial},
                                  {"return", t.total_reward},
                                  {"policy", t.policy},
                                  {"theta", std::vector<double>(t.theta.begin(), t.theta.end())}};
  };
  nlohmann::ordered_json all = {
      {"format", 1}, {"scenario", resolved.spec.scenario}, {"learner", resolved.spec.learner}};
  if (!trials.empty()) all["best"] = entry(best_trial(trials));
  all["trials"] = nlohmann::ordered_json::array();
  for (const TrialRecord& t : trials) all["trials"].push_back(entry(t));
  return all.dump(1) + "\n";
}

std::string learners_csv(const learners::Table& table) {
  files::Csv csv(table.columns);
  for (Index i = 0; i < table.rows.rows(); ++i) {
    Row row;
    add_numbers(row, table.rows.row(i));
    csv.row(row);
  }
  return csv.text();
}

std::string trajectory_csv(const Task& task, const Episode& episode) {
  Row header = {"time [s]"};
  add_states(header, task, "{}");
  add_states(header, task, "true {}");
  for (const ActionVariable& action : task.actions) header.push_back(with_unit(action.name, action.unit));
  header.push_back("reward");
  files::Csv csv(header);
  for (Index t = 0; t <= episode.steps(); ++t) {
    Row row = {files::Csv::cell(seconds(static_cast<Index>(t), task.dt_s))};
    add_numbers(row, episode.states.row(t));
    add_numbers(row, episode.true_states.row(t));
    if (t < episode.steps())
      add_numbers(row, episode.actions.row(t));
    else
      row.resize(row.size() + task.actions.size());
    row.push_back(t > 0 ? files::Csv::cell(episode.rewards(t - 1)) : "");
    csv.row(row);
  }
  return csv.text();
}

std::string prediction_csv(const Task& task, const rollout::Recorded& recorded, const ExpectedEpisode* moments) {
  constexpr std::array<double, 5> kFractions = {0.05, 0.25, 0.5, 0.75, 0.95};
  Row header = {"time [s]", "particles"};
  for (const std::string format : {"{} mean", "{} 5%", "{} 25%", "{} 50%", "{} 75%", "{} 95%"})
    add_states(header, task, format);
  if (moments) add_moments_header(header, task);
  files::Csv csv(header);
  for (std::size_t t = 0; t < recorded.states.size(); ++t) {
    const Matrix& states = recorded.states[t];
    const Index going = (states.col(0).array() == states.col(0).array()).count();  // the others are NaN
    Row row = {files::Csv::cell(seconds(static_cast<Index>(t), task.dt_s)), files::Csv::cell(going)};
    add_numbers(row, statistics::column_means(states));
    for (double fraction : kFractions) add_numbers(row, statistics::column_quantiles(states, fraction));
    if (moments) add_moments(row, recorded, *moments, static_cast<Index>(t));
    csv.row(row);
  }
  return csv.text();
}

}  // namespace rehearse::experiment
