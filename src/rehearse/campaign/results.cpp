#include "rehearse/campaign/results.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace rehearse::campaign {

void RunOutcome::fail(std::string why) {
  for (std::size_t end = why.find('\n'); end != std::string::npos; end = why.find('\n', end)) why.replace(end, 1, "; ");
  state = RunState::failed;
  reason = std::move(why);
}

std::optional<std::size_t> RunOutcome::row_of(Index trial) const {
  if (done() < trial && state != RunState::done) return std::nullopt;
  return static_cast<std::size_t>(std::min(trial, done()) - 1);
}

std::optional<Index> RunOutcome::first_success(Index until) const {
  for (Index trial = 1; trial <= std::min(until, done()); ++trial)
    if (solved[static_cast<std::size_t>(trial - 1)].value_or(false)) return trial;
  return std::nullopt;
}

double RunOutcome::best_return(Index until) const {
  return *std::max_element(returns.begin(), returns.begin() + std::min(until, done()));
}

std::vector<std::string> Campaign::remarks() const {
  std::vector<std::string> lines;
  for (const auto& [name, reason] : plan.missing) lines.push_back(fmt::format("missing: {}", reason));
  for (const auto& [path, reason] : skipped) lines.push_back(fmt::format("skipped: {}: {}", path, reason));
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].unusable) lines.push_back(fmt::format("cannot be used: {}: {}", plan.runs[i].name, runs[i].reason));
  return lines;
}

Index Campaign::count(RunState state) const { return std::ranges::count(runs, state, &RunOutcome::state); }

Index Campaign::count(RunState state, std::size_t group) const {
  const auto first = runs.begin() + static_cast<std::ptrdiff_t>(plan.index_of(group, 0));
  return std::ranges::count(first, first + std::ssize(plan.seeds), state, &RunOutcome::state);
}

RunOutcome outcome_of(files::Table trials, Index planned_trials) {
  RunOutcome outcome{.trials = std::move(trials)};
  const std::size_t rows = std::min(outcome.trials.rows.size(), static_cast<std::size_t>(planned_trials));
  outcome.trials.rows.resize(rows);
  for (const auto& number : outcome.trials.numbers("interaction_s"))
    outcome.interaction_s.push_back(number.value_or(0));
  for (const auto& number : outcome.trials.numbers("return")) outcome.returns.push_back(number.value_or(-kInf));
  for (const auto& number : outcome.trials.numbers("solved"))
    outcome.solved.push_back(number ? std::optional(*number != 0) : std::nullopt);
  return outcome;
}

}  // namespace rehearse::campaign
