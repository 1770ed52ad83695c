#include "rehearse/experiment/trial_record.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/tables.hpp"
#include "rehearse/identification/identifiability.hpp"
#include "rehearse/statistics/intervals.hpp"

namespace rehearse::experiment {
namespace {

std::vector<double> tunable_values(const learners::Proposal& proposal, const std::optional<prior::Prior>& prior) {
  std::vector<double> values;
  if (!proposal.phi || !prior) return values;
  const ParameterSpace& space = prior->space;
  for (Index i = 0; i < space.size() && i < proposal.phi->size(); ++i)
    if (space[i].tunable()) values.push_back((*proposal.phi)(i));
  return values;
}

void add_posterior(TrialRecord& record, const identification::PhiPosterior& posterior,
                   const std::vector<std::string>& names) {
  const auto intervals = posterior.intervals();
  for (const std::string& name : names) {
    record.phi_intervals.emplace_back();
    for (std::size_t i = 0; i < intervals.size(); ++i)
      if (posterior.parameters[i].name == name) record.phi_intervals.back() = intervals[i];
  }
  record.warnings = identification::identifiability_warnings(posterior);
}

/// The records of the limits before the trial.
std::vector<LimitRecord> limits_of(const Task& task, const learners::Proposal& proposal) {
  std::vector<LimitRecord> records;
  for (std::size_t l = 0; l < task.limits.size(); ++l) {
    LimitRecord record{.limit = task.limits[l].name, .allowed = task.limits[l].risk};
    if (l < proposal.risks.size()) {
      const statistics::Rate risk = statistics::rate(proposal.risks[l].broken, proposal.risks[l].episodes);
      record.predicted = risk.value();
      record.interval = risk.interval;
    }
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace

std::string why_rollouts_failed(const learners::Proposal& proposal) {
  return proposal.failed_row.empty() ? "the model's predictions, or their rewards, were not finite"
                                     : "the prior fails " + proposal.failed_row;
}

TrialRecord record_before(Index trial, const learners::Proposal& proposal, const Resolved& resolved) {
  TrialRecord record{.trial = trial,
                     .predicted_return = proposal.predicted_return,
                     .limits = limits_of(resolved.scenario.task, proposal),
                     .rollouts = proposal.rollouts,
                     .failed_rollouts = proposal.failed_rollouts,
                     .log_evidence = proposal.log_evidence,
                     .phi = tunable_values(proposal, resolved.prior),
                     .policy = proposal.policy->name(),
                     .theta = proposal.theta,
                     .notes = proposal.notes,
                     .model_s = proposal.model_s,
                     .search_s = proposal.search_s};
  if (proposal.left_out_rows > 0)
    record.notes.push_back(
        fmt::format("{} training rows left out: a change, or the prior's prediction of it, was not finite",
                    proposal.left_out_rows));
  if (10 * proposal.failed_rollouts > proposal.rollouts)
    record.notes.push_back(fmt::format("{} of {} rollouts failed: {}", proposal.failed_rollouts, proposal.rollouts,
                                       why_rollouts_failed(proposal)));
  if (proposal.posterior && !record.phi.empty())
    add_posterior(record, *proposal.posterior, tunable_names(resolved.prior));
  return record;
}

void add_outcome(TrialRecord& record, const Episode& episode, const Task& task) {
  record.total_reward = episode.total_reward();
  for (LimitRecord& limit : record.limits) limit.broken = std::ranges::count(episode.broken_limits, limit.limit) > 0;
  if (!episode.failure.empty()) record.notes.push_back("the episode ended at the reward floor: " + episode.failure);
  if (episode.ended && episode.failure.empty() && episode.broken_limits.empty() && !task.ended)
    record.notes.push_back(fmt::format(
        "the robot itself ended the episode in step {}, which no simulated episode knows: say when it ends by `ended`, "
        "or by a limit",
        episode.steps()));
  record.cut_short = episode.is_cut_short(task.horizon);
  if (task.solved && !record.cut_short) record.solved = task.solved(episode);
}

}  // namespace rehearse::experiment
