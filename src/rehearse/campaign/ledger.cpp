#include "rehearse/campaign/ledger.hpp"

#include <exception>
#include <stdexcept>
#include <thread>

#include <nlohmann/json.hpp>

namespace rehearse::campaign {
namespace {

using nlohmann::json;

constexpr std::chrono::milliseconds kBetweenProgress{200}, kBetweenLooks{1};

json to_json(const RunOutcome& outcome) {
  return {{"state", outcome.state},
          {"reason", outcome.reason},
          {"header", outcome.trials.header},
          {"rows", outcome.trials.rows}};
}

RunOutcome to_outcome(const json& j) {
  files::Table trials{.header = j.at("header"), .rows = j.at("rows")};
  const auto rows = static_cast<Index>(trials.rows.size());
  RunOutcome outcome;
  if (!trials.header.empty()) outcome = outcome_of(std::move(trials), rows);
  outcome.state = j.at("state").get<RunState>();
  outcome.reason = j.at("reason").get<std::string>();
  return outcome;
}

json to_json(const Progress& p) {
  return {
      {"phase", p.phase}, {"done", p.done}, {"best", p.best}, {"rollouts", p.rollouts}, {"per_s", p.rollouts_per_s}};
}

Progress to_progress(const json& j) {
  return {.phase = j.at("phase"),
          .done = j.at("done"),
          .best = j.at("best"),
          .rollouts = j.at("rollouts"),
          .rollouts_per_s = j.at("per_s")};
}

/// CBOR keeps every double, and infinity.
std::string to_bytes(const json& j) {
  std::string bytes;
  json::to_cbor(j, bytes);
  return bytes;
}

}  // namespace

template <class Tell>
void OwnLedger::tell(Tell tell) {
  const std::lock_guard lock(mutex_);
  if (options_.listener) tell(*options_.listener);
}

std::optional<std::size_t> OwnLedger::next() {
  const std::lock_guard lock(mutex_);
  while (next_ < campaign_.runs.size() && campaign_.runs[next_].state != RunState::unfinished) ++next_;
  if (stopped() || next_ >= campaign_.runs.size()) return std::nullopt;
  return next_++;
}

void OwnLedger::run_started(std::size_t run, Index trials_done) {
  tell([&](CampaignListener& listener) { listener.run_started(run, trials_done); });
}

void OwnLedger::progress(std::size_t run, Index trial, const Progress& progress) {
  tell([&](CampaignListener& listener) { listener.progress(run, trial, progress); });
  const std::lock_guard lock(mutex_);
  if (!written_) write_if_due();
}

void OwnLedger::trial_done(std::size_t run, RunOutcome so_far) { update(run, std::move(so_far)); }

void OwnLedger::run_ended(std::size_t run, RunOutcome outcome) {
  update(run, outcome);
  if (outcome.state == RunState::unfinished) return;
  tell([&](CampaignListener& listener) { listener.run_ended(run, outcome); });
}

void OwnLedger::update(std::size_t run, RunOutcome outcome) {
  const std::lock_guard lock(mutex_);
  campaign_.runs[run] = std::move(outcome);
  written_ = false;
  write_if_due();
}

void OwnLedger::write_if_due() {
  if (options_.share.of > 1 || Clock::now() < next_write_) return;
  const auto begin = Clock::now();
  try {
    folder_.write(campaign_);
    written_ = true;
  } catch (const std::runtime_error&) {  // a full disk: the last write says so, if it still is
  }
  const auto end = Clock::now();
  next_write_ = end + std::max<Clock::duration>(std::chrono::seconds(1), 20 * (end - begin));
}

json DistantLedger::ask(const json& question) {
  json answer = json::from_cbor(ranks_.ask(to_bytes(question)));
  if (answer.at("stop").get<bool>()) stopped_ = true;
  return answer;
}

std::optional<std::size_t> DistantLedger::next() {
  const json run = ask({{"do", "next"}}).at("run");
  if (run.is_null() || stopped()) return std::nullopt;
  return run.get<std::size_t>();
}

void DistantLedger::run_started(std::size_t run, Index trials_done) {
  ask({{"do", "run_started"}, {"run", run}, {"trials", trials_done}});
}

void DistantLedger::progress(std::size_t run, Index trial, const Progress& progress) {
  if (Clock::now() < next_progress_.load()) return;
  next_progress_ = Clock::now() + kBetweenProgress;
  ask({{"do", "progress"}, {"run", run}, {"trial", trial}, {"progress", to_json(progress)}});
}

void DistantLedger::trial_done(std::size_t run, RunOutcome so_far) {
  ask({{"do", "trial_done"}, {"run", run}, {"outcome", to_json(so_far)}});
}

void DistantLedger::run_ended(std::size_t run, RunOutcome outcome) {
  ask({{"do", "run_ended"}, {"run", run}, {"outcome", to_json(outcome)}});
}

void DistantLedger::close(const std::string& failure) { ask({{"do", "close"}, {"failure", failure}}); }

namespace {

/// Performs the request of a distant ledger on the ledger itself. Returns the run for "next".
json perform(const json& question, OwnLedger& ledger) {
  const std::string what = question.at("do");
  if (what == "next") {
    const auto run = ledger.next();
    return run ? json(*run) : json();
  }
  if (what == "run_started") ledger.run_started(question.at("run"), question.at("trials"));
  if (what == "progress")
    ledger.progress(question.at("run"), question.at("trial"), to_progress(question.at("progress")));
  if (what == "trial_done") ledger.trial_done(question.at("run"), to_outcome(question.at("outcome")));
  if (what == "run_ended") ledger.run_ended(question.at("run"), to_outcome(question.at("outcome")));
  if (what == "close" && question.at("failure") != "") throw std::runtime_error(question.at("failure"));
  return {};
}

}  // namespace

void answer_distant_ledgers(Ranks& ranks, OwnLedger& ledger) {
  std::exception_ptr failure;
  int open = ranks.size() - 1;
  const auto reply = [&](const std::string& bytes) {
    json run;
    try {
      const json question = json::from_cbor(bytes);
      open -= question.at("do") == "close";
      run = perform(question, ledger);
    } catch (...) {
      if (!failure) failure = std::current_exception();
      ledger.stop();
    }
    return to_bytes({{"run", run}, {"stop", ledger.stopped()}});
  };
  while (open > 0)
    if (!ranks.answer(reply)) std::this_thread::sleep_for(kBetweenLooks);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace rehearse::campaign
