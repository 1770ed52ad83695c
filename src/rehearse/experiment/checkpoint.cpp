#include "rehearse/experiment/checkpoint.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/seal.hpp"
#include "rehearse/learners/json.hpp"

namespace rehearse::experiment {
namespace {

using learners::to_json, learners::to_vector;
using nlohmann::json;

constexpr const char* kCheckpointKind = "checkpoint";

template <class T>
json from_optional(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

template <class T>
void to_optional(const json& j, std::optional<T>& value) {
  if (!j.is_null()) value = j.get<T>();
}

json from_forecast(const ForecastError& f) {
  return {{"horizon", f.horizon}, {"compared", f.compared}, {"failed", f.failed}, {"rms", to_json(f.rms)}};
}

ForecastError to_forecast(const json& j) {
  return {j.at("horizon").get<Index>(), j.at("compared").get<Index>(), j.at("failed").get<Index>(),
          to_vector(j.at("rms"))};
}

json from_intervals(const std::vector<std::optional<Interval>>& intervals) {
  json all = json::array();
  for (const auto& interval : intervals) all.push_back(interval ? json{interval->low, interval->high} : json());
  return all;
}

std::vector<std::optional<Interval>> to_intervals(const json& j) {
  std::vector<std::optional<Interval>> intervals;
  for (const json& interval : j)
    intervals.push_back(interval.is_null()
                            ? std::nullopt
                            : std::optional<Interval>({interval.at(0).get<double>(), interval.at(1).get<double>()}));
  return intervals;
}

json from_limits(const std::vector<LimitRecord>& limits) {
  json all = json::array();
  for (const LimitRecord& l : limits)
    all.push_back({{"limit", l.limit},
                   {"allowed", l.allowed},
                   {"predicted", from_optional(l.predicted)},
                   {"interval", {l.interval.low, l.interval.high}},
                   {"broken", l.broken}});
  return all;
}

std::vector<LimitRecord> to_limits(const json& j) {
  std::vector<LimitRecord> limits;
  for (const json& l : j) {
    LimitRecord record{.limit = l.at("limit"), .allowed = l.at("allowed")};
    to_optional(l.at("predicted"), record.predicted);
    record.interval = {l.at("interval").at(0), l.at("interval").at(1)};
    l.at("broken").get_to(record.broken);
    limits.push_back(std::move(record));
  }
  return limits;
}

json from_record(const TrialRecord& r) {
  json forecast = json::array();
  for (const ForecastError& f : r.forecast) forecast.push_back(from_forecast(f));
  json j = {{"trial", r.trial},
            {"interaction_s", r.interaction_s},
            {"return", r.total_reward},
            {"expected_return", from_optional(r.expected_return)},
            {"solved", from_optional(r.solved)},
            {"predicted_return", from_optional(r.predicted_return)},
            {"limits", from_limits(r.limits)},
            {"rollouts", r.rollouts},
            {"failed_rollouts", r.failed_rollouts},
            {"log_evidence", from_optional(r.log_evidence)},
            {"phi", r.phi},
            {"phi_intervals", from_intervals(r.phi_intervals)},
            {"warnings", r.warnings},
            {"policy", r.policy},
            {"theta", to_json(r.theta)},
            {"forecast", forecast},
            {"notes", r.notes},
            {"model_s", r.model_s},
            {"search_s", r.search_s},
            {"file", r.file_checksum}};
  if (r.cut_short) j["cut_short"] = true;
  return j;
}

TrialRecord to_record(const json& j) {
  TrialRecord r;
  j.at("trial").get_to(r.trial);
  j.at("interaction_s").get_to(r.interaction_s);
  j.at("return").get_to(r.total_reward);
  to_optional(j.value("expected_return", json()), r.expected_return);
  to_optional(j.at("solved"), r.solved);
  r.cut_short = j.value("cut_short", false);
  to_optional(j.at("predicted_return"), r.predicted_return);
  r.limits = to_limits(j.value("limits", json::array()));
  j.at("rollouts").get_to(r.rollouts);
  j.at("failed_rollouts").get_to(r.failed_rollouts);
  to_optional(j.at("log_evidence"), r.log_evidence);
  j.at("phi").get_to(r.phi);
  r.phi_intervals = to_intervals(j.value("phi_intervals", json::array()));
  r.warnings = j.value("warnings", std::vector<std::string>());
  r.policy = j.value("policy", "");
  r.theta = to_vector(j.at("theta"));
  for (const json& f : j.at("forecast")) r.forecast.push_back(to_forecast(f));
  j.at("notes").get_to(r.notes);
  j.at("model_s").get_to(r.model_s);
  j.at("search_s").get_to(r.search_s);
  r.file_checksum = j.value("file", "");
  return r;
}

json from_log(const Log& log) {
  return {{"name", log.name}, {"file", log.file_checksum}, {"episode", to_json(log.episode)}, {"notes", log.notes}};
}

Log to_log(const json& j) {
  return {j.at("name").get<std::string>(), j.at("file").get<std::string>(), learners::to_episode(j.at("episode")),
          j.at("notes").get<std::vector<std::string>>()};
}

[[noreturn]] void refuse_contradiction(const std::string& what) {
  throw InvalidInput("the checkpoint contradicts itself: " + what);
}

/// One that ended before its first action has one state.
void check_rows(const Episode& e, const std::string& name) {
  const Index steps = e.steps();
  const bool rows = e.states.rows() == steps + 1 && e.true_states.rows() == steps + 1 && e.rewards.size() == steps;
  if (!rows || e.true_states.cols() != e.states.cols())
    refuse_contradiction(fmt::format("{} has {} × {} states, {} × {} true states and {} rewards in {} steps", name,
                                     e.states.rows(), e.states.cols(), e.true_states.rows(), e.true_states.cols(),
                                     e.rewards.size(), steps));
}

void check_history(const History& history) {
  const Index done = history.done();
  if (static_cast<Index>(history.episodes.size()) != done)
    refuse_contradiction(fmt::format("{} trials have {} episodes", done, history.episodes.size()));
  if (history.told < std::max<Index>(done - 1, 0) || history.told > done)
    refuse_contradiction(
        fmt::format("the learner was told {} of {} trials, must be all but perhaps the last", history.told, done));
  for (Index i = 0; i < done; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (history.trials[at].trial != i + 1)
      refuse_contradiction(fmt::format("trial {} has the number {}", i + 1, history.trials[at].trial));
    check_rows(history.episodes[at], fmt::format("trial {}", i + 1));
  }
  if (history.asked && history.asked->trial != done + 1)
    refuse_contradiction(fmt::format("trial {} is to come after {}", history.asked->trial, done));
  for (const Log& log : history.logs) check_rows(log.episode, fmt::format("log {}", log.name));
}

History to_history(const json& j) {
  History history;
  for (const json& r : j.at("trials")) history.trials.push_back(to_record(r));
  for (const json& e : j.at("episodes")) history.episodes.push_back(learners::to_episode(e));
  history.told = j.at("told").get<Index>();
  history.learner = j.at("learner");
  for (const json& log : j.value("logs", json::array())) history.logs.push_back(to_log(log));
  if (const json asked = j.value("asked", json()); !asked.is_null()) history.asked = to_record(asked);
  check_history(history);
  return history;
}

}  // namespace

std::string to_checkpoint(const History& history, std::uint64_t spec_fingerprint) {
  json trials = json::array(), episodes = json::array();
  for (const TrialRecord& record : history.trials) trials.push_back(from_record(record));
  for (const Episode& episode : history.episodes) episodes.push_back(to_json(episode));
  json logs = json::array();
  for (const Log& log : history.logs) logs.push_back(from_log(log));
  const json all = {{"spec", spec_fingerprint},
                    {"trials", trials},
                    {"episodes", episodes},
                    {"told", history.told},
                    {"learner", history.learner},
                    {"logs", logs},
                    {"asked", history.asked ? from_record(*history.asked) : json()}};
  std::string body;
  json::to_cbor(all, body);
  return files::seal(kCheckpointKind, body);
}

History from_checkpoint(std::string_view bytes, std::uint64_t spec_fingerprint) {
  const std::string_view body = files::unseal(kCheckpointKind, bytes);
  try {
    const json all = json::from_cbor(body);
    if (all.at("spec").get<std::uint64_t>() != spec_fingerprint)
      throw InvalidInput("the checkpoint belongs to another spec.toml: it was changed since the run began");
    return to_history(all);
  } catch (const json::exception&) {
    throw InvalidInput("the checkpoint is damaged");
  }
}

}  // namespace rehearse::experiment
