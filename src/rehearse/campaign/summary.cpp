#include "rehearse/campaign/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/campaign/claims.hpp"
#include "rehearse/experiment/tables.hpp"
#include "rehearse/files/csv.hpp"
#include "rehearse/statistics/intervals.hpp"

namespace rehearse::campaign {
namespace {

using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;

std::vector<const RunOutcome*> runs_of(const Campaign& campaign, std::size_t group) {
  std::vector<const RunOutcome*> runs;
  for (std::size_t seed = 0; seed < campaign.plan.seeds.size(); ++seed) runs.push_back(&campaign.outcome(group, seed));
  return runs;
}

/// The runs of a group as they are at a trial. Where runs end when they are solved, one that is under way stands for
/// later trials with its last so far: without it those that ended early would stand for all.
struct GroupAt {
  const std::vector<const RunOutcome*>& runs;
  Index trial;
  bool until_solved;

  std::optional<std::size_t> row_of(const RunOutcome& run) const {
    const bool under_way = run.state == RunState::unfinished && run.done() > 0;
    return run.row_of(until_solved && under_way ? std::min(trial, run.done()) : trial);
  }

  /// Those that failed count as not solved.
  bool counts(const RunOutcome& run) const { return row_of(run) || run.state == RunState::failed; }
};

/// Counts the runs for which `solved` holds among those that count.
template <class Solved>
std::optional<statistics::Rate> success_rate(const GroupAt& at, Solved solved) {
  Index count = 0, of = 0;
  for (const RunOutcome* run : at.runs) {
    if (!at.counts(*run)) continue;
    if (std::any_of(run->solved.begin(), run->solved.end(), [](const auto& s) { return !s; })) return std::nullopt;
    ++of;
    count += solved(*run);
  }
  return statistics::rate(count, of);
}

TrialStatistics statistics_of(const GroupAt& at) {
  const Index trial = at.trial;
  std::vector<double> interaction, returns, best;
  for (const RunOutcome* run : at.runs) {
    const auto row = at.row_of(*run);
    if (!row) continue;
    if (trial <= run->done()) interaction.push_back(run->interaction_s[*row]);
    returns.push_back(run->returns[*row]);
    best.push_back(run->best_return(trial));
  }
  const auto now = [&](const RunOutcome& run) {
    const auto row = at.row_of(run);
    return row && run.solved[*row].value_or(false);
  };
  const auto until_now = [&](const RunOutcome& run) { return run.first_success(trial).has_value(); };
  return {.trial = trial,
          .runs = static_cast<Index>(returns.size()),
          .interaction_s = statistics::median(interaction),
          .total_reward = statistics::five_numbers(returns),
          .best_return = statistics::five_numbers(best),
          .solved = success_rate(at, now),
          .solved_by = success_rate(at, until_now)};
}

/// JSON has no infinity and no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json to_json(const statistics::FiveNumbers& five) {
  return {{"min", number(five.min)},
          {"quartile_1", number(five.quartile_1)},
          {"median", number(five.median)},
          {"quartile_3", number(five.quartile_3)},
          {"max", number(five.max)}};
}

Json to_json(const std::optional<statistics::Rate>& rate) {
  if (!rate) return {};
  return {{"runs", rate->of},
          {"count", rate->count},
          {"rate", number(rate->value())},
          {"low", number(rate->interval.low)},
          {"high", number(rate->interval.high)}};
}

const char* to_text(RunState state) {
  return state == RunState::done ? "done" : state == RunState::failed ? "failed" : "unfinished";
}

/// The groups' names without repetition, in order of first appearance.
Json names_of(const CampaignPlan& plan, const std::vector<std::size_t>& groups, std::string CampaignGroup::*name) {
  Json all = Json::array();
  for (std::size_t group : groups)
    if (std::find(all.begin(), all.end(), plan.groups[group].*name) == all.end())
      all.push_back(plan.groups[group].*name);
  return all;
}

Json runs_json(const Campaign& campaign) {
  Json all = Json::array();
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const PlannedRun& run = campaign.plan.runs[i];
    const CampaignGroup& group = campaign.plan.groups[run.group];
    const RunOutcome& outcome = campaign.runs[i];
    all.push_back({{"run", run.name},
                   {"folder", "runs/" + run.name},
                   {"learner", group.learner},
                   {"prior", group.prior},
                   {"variant", group.variant},
                   {"seed", run.spec.seed},
                   {"state", to_text(outcome.state)},
                   {"trials", outcome.done()},
                   {"first_success", or_null(outcome.first_success(campaign.plan.trials))},
                   {"best_return", outcome.done() > 0 ? number(outcome.best_return(outcome.done())) : Json()},
                   {"reason", text_or_null(outcome.reason)}});
  }
  return all;
}

Json group_json(const Campaign& campaign, std::size_t index) {
  const CampaignGroup& group = campaign.plan.groups[index];
  Json json = {{"learner", group.learner},
               {"prior", group.prior},
               {"variant", group.variant},
               {"options", Json::object()},
               {"runs", campaign.plan.seeds.size()},
               {"done", campaign.count(RunState::done, index)},
               {"failed", campaign.count(RunState::failed, index)},
               {"trials", Json::array()}};
  for (const auto& [key, text] : group.options) json["options"][key] = text;
  for (const TrialStatistics& trial : trial_statistics(campaign, index))
    json["trials"].push_back({{"trial", trial.trial},
                              {"runs", trial.runs},
                              {"interaction_s", number(trial.interaction_s)},
                              {"return", to_json(trial.total_reward)},
                              {"best_return", to_json(trial.best_return)},
                              {"solved", to_json(trial.solved)},
                              {"solved_by", to_json(trial.solved_by)}});
  return json;
}

Json against_json(const CampaignPlan& plan, const PlannedClaim& claim, const ClaimPart& part) {
  if (!claim.claim.comparison) return {};
  const Json learners = names_of(plan, part.against, &CampaignGroup::learner);
  return {{"learner", learners.empty() ? Json(claim.claim.comparison->learner.value_or("")) : learners.front()},
          {"priors", names_of(plan, part.against, &CampaignGroup::prior)},
          {"variants", names_of(plan, part.against, &CampaignGroup::variant)}};
}

Json part_json(const CampaignPlan& plan, const PlannedClaim& claim, const ClaimPart& part, const PartResult& result) {
  return {{"learner", claim.claim.learner},
          {"priors", names_of(plan, part.groups, &CampaignGroup::prior)},
          {"variants", names_of(plan, part.groups, &CampaignGroup::variant)},
          {"against", against_json(plan, claim, part)},
          {"measure", result.measure},
          {"runs", result.runs},
          {"of", result.of},
          {"count", or_null(result.count)},
          {"estimate", number(result.estimate)},
          {"low", number(result.interval.low)},
          {"high", number(result.interval.high)},
          {"required", result.required},
          {"result", to_text(result.verdict)},
          {"reason", text_or_null(result.reason)}};
}

Json claims_json(const Campaign& campaign) {
  const std::vector<ClaimResult> results = judge(campaign);
  Json all = Json::array();
  for (std::size_t i = 0; i < results.size(); ++i) {
    const PlannedClaim& claim = campaign.plan.claims[i];
    const char* kind = claim.claim.success ? "success" : claim.claim.comparison ? "comparison" : "median";
    Json parts = Json::array();
    for (std::size_t k = 0; k < claim.parts.size(); ++k)
      parts.push_back(part_json(campaign.plan, claim, claim.parts[k], results[i].parts[k]));
    all.push_back({{"text", claim.claim.text},
                   {"line", claim.claim.line},
                   {"kind", kind},
                   {"result", to_text(results[i].verdict)},
                   {"parts", parts}});
  }
  return all;
}

/// Columns of trials.csv in all runs, the common ones first.
Row trial_columns(const Campaign& campaign) {
  Row columns = files::read_csv(experiment::trials_csv({}, {})).header;
  for (const RunOutcome& run : campaign.runs)
    for (const std::string& column : run.trials.header)
      if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  return columns;
}

}  // namespace

std::vector<TrialStatistics> trial_statistics(const Campaign& campaign, std::size_t group) {
  const auto runs = runs_of(campaign, group);
  Index trials = 0;
  for (const RunOutcome* run : runs)
    trials = std::max(trials, run->state == RunState::unfinished ? run->done() : campaign.plan.trials);
  std::vector<TrialStatistics> all;
  for (Index trial = 1; trial <= trials; ++trial)
    all.push_back(statistics_of({runs, trial, campaign.plan.until_solved}));
  return all;
}

std::string campaign_csv(const Campaign& campaign) {
  const Row columns = trial_columns(campaign);
  Row header = {"run", "scenario", "learner", "prior", "variant", "seed"};
  const std::size_t identification = header.size();
  header.insert(header.end(), columns.begin(), columns.end());
  files::Csv csv(header);
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const PlannedRun& run = campaign.plan.runs[i];
    const CampaignGroup& group = campaign.plan.groups[run.group];
    const files::Table& trials = campaign.runs[i].trials;
    Row row = {run.name, run.spec.scenario, group.learner, group.prior, group.variant, files::Csv::cell(run.spec.seed)};
    row.resize(header.size());
    std::vector<std::size_t> places;
    for (const std::string& column : trials.header)
      places.push_back(static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin()));
    for (const Row& cells : trials.rows) {
      for (std::size_t k = 0; k < cells.size(); ++k) row[identification + places[k]] = cells[k];
      csv.row(row);
    }
  }
  return csv.text();
}

std::string summary_json(const Campaign& campaign) {
  const CampaignPlan& plan = campaign.plan;
  std::vector<std::size_t> everything(plan.groups.size());
  std::iota(everything.begin(), everything.end(), std::size_t{0});
  Json all = {{"format", 1},
              {"title", plan.title},
              {"scenario", plan.scenario},
              {"trials", plan.trials},
              {"seeds", plan.seeds},
              {"learners", names_of(plan, everything, &CampaignGroup::learner)},
              {"priors", names_of(plan, everything, &CampaignGroup::prior)},
              {"variants", names_of(plan, everything, &CampaignGroup::variant)},
              {"complete", campaign.complete()},
              {"counts",
               {{"runs", campaign.runs.size()},
                {"done", campaign.count(RunState::done)},
                {"failed", campaign.count(RunState::failed)},
                {"unfinished", campaign.count(RunState::unfinished)}}},
              {"missing", Json::array()},
              {"skipped", Json::array()},
              {"runs", runs_json(campaign)},
              {"groups", Json::array()},
              {"claims", claims_json(campaign)}};
  for (const auto& [name, reason] : plan.missing) all["missing"].push_back({{"learner", name}, {"reason", reason}});
  for (const auto& [path, reason] : campaign.skipped) all["skipped"].push_back({{"path", path}, {"reason", reason}});
  for (std::size_t group = 0; group < plan.groups.size(); ++group) all["groups"].push_back(group_json(campaign, group));
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rehearse::campaign
