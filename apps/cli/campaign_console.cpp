#include "apps/cli/campaign_console.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/cli/complain.hpp"
#include "rehearse/campaign/claims.hpp"
#include "rehearse/campaign/summary.hpp"
#include "rehearse/core/text_table.hpp"

namespace rehearse::apps {
namespace {

using campaign::Campaign, campaign::CampaignGroup, campaign::ClaimPart, campaign::ClaimResult, campaign::PartResult,
    campaign::RunOutcome, campaign::RunState, campaign::TrialStatistics, campaign::Verdict;
using Seconds = std::chrono::duration<double>;

std::string label_of(const CampaignGroup& group) {
  std::string label = group.learner;
  for (const std::string& part : {group.prior, group.variant})
    if (!part.empty()) label += " " + part;
  return label;
}

std::string outcome_text(const RunOutcome& outcome, Index trials) {
  if (outcome.state == RunState::failed) return "FAILED: " + outcome.reason;
  const auto solved = outcome.first_success(trials);
  return fmt::format("{}, best return {:.3f}", solved ? fmt::format("solved at trial {}", *solved) : "not solved",
                     outcome.best_return(trials));
}

/// "3 of 3 (0.29 to 1)"
std::string rate_text(const std::optional<statistics::Rate>& rate) {
  if (!rate) return "-";
  return fmt::format("{} of {} ({:.2g} to {:.2g})", rate->count, rate->of, rate->interval.low, rate->interval.high);
}

std::string numbers_text(const statistics::FiveNumbers& five) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", five.median, five.quartile_1, five.quartile_3);
}

/// "4 3 - 4": trials; "-" where the task was not solved, "?" where that is not known yet.
std::string first_successes(const Campaign& campaign, std::size_t group) {
  const Index last = campaign.plan.trials;
  std::vector<std::string> trials;
  for (std::size_t seed = 0; seed < campaign.plan.seeds.size(); ++seed) {
    const RunOutcome& run = campaign.outcome(group, seed);
    const auto first = run.first_success(last);
    trials.push_back(first ? std::to_string(*first) : run.decided(last) ? "-" : "?");
  }
  return fmt::format("{}", fmt::join(trials, " "));
}

void print_groups(const Campaign& campaign) {
  const Index last = campaign.plan.trials;
  std::vector<std::vector<std::string>> rows = {{"learner", "runs", fmt::format("solved by trial {} (95 %)", last),
                                                 fmt::format("return of trial {} (quartiles)", last),
                                                 "first solved at, by seed"}};
  for (std::size_t i = 0; i < campaign.plan.groups.size(); ++i) {
    const std::vector<TrialStatistics> trials = campaign::trial_statistics(campaign, i);
    const bool reached = !trials.empty() && trials.back().trial == last;
    rows.push_back({label_of(campaign.plan.groups[i]),
                    fmt::format("{}/{}", campaign.count(RunState::done, i), campaign.plan.seeds.size()),
                    reached ? rate_text(trials.back().solved_by) : "-",
                    reached && trials.back().runs > 0 ? numbers_text(trials.back().total_reward) : "-",
                    trials.empty() || trials.back().solved ? first_successes(campaign, i) : "-"});
  }
  put("\n");
  for (const std::string& line : aligned(rows)) put("  {}\n", line);
  for (const auto& [name, reason] : campaign.plan.missing) put("  missing: {}\n", reason);
}

void print_failures(const Campaign& campaign, bool unusable, const char* headline) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
    const RunOutcome& run = campaign.runs[i];
    if (run.state == RunState::failed && run.unusable == unusable)
      lines.push_back(fmt::format("  {}: {}\n", campaign.plan.runs[i].name, run.reason));
  }
  if (!lines.empty()) put("\n{}\n{}", headline, fmt::join(lines, ""));
}

void print_failures(const Campaign& campaign) {
  print_failures(campaign, false, "Failed; tried again when the campaign is started again");
  print_failures(campaign, true, "Failed, since their folders cannot be used; removed ones are begun anew");
}

const char* word_for(Verdict verdict) { return verdict == Verdict::fail ? "FAIL" : to_text(verdict); }

std::string labels_of(const Campaign& campaign, const std::vector<std::size_t>& groups) {
  std::vector<std::string> labels;
  for (std::size_t group : groups) {
    const std::string label = label_of(campaign.plan.groups[group]);
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  }
  return fmt::format("{}", fmt::join(labels, " + "));
}

/// "mi useful against gp-mi useful: 1.2 (-0.3 to 2.7)"
std::string part_text(const Campaign& campaign, const ClaimPart& part, const PartResult& result) {
  std::string text = labels_of(campaign, part.groups);
  if (!part.against.empty()) text += " against " + labels_of(campaign, part.against);
  if (result.runs > 0) text += ": ";
  if (result.runs > 0)
    text += result.count ? fmt::format("{} of {}", *result.count, result.runs) : fmt::format("{:.3g}", result.estimate);
  if (result.runs > 0 && std::isfinite(result.interval.low))
    text += fmt::format(" ({:.3g} to {:.3g})", result.interval.low, result.interval.high);
  const std::string separator = text.empty() ? "" : "; ";
  return result.reason.empty() ? text : text + separator + result.reason;
}

void print_claims(const Campaign& campaign) {
  const std::vector<ClaimResult> results = campaign::judge(campaign);
  if (!results.empty()) put("\nClaims, with 95 % intervals\n");
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto& [claim, parts, missing] = campaign.plan.claims[i];
    const PartResult& first = results[i].parts.front();
    put("  {:<10} {} ({}: {})\n", word_for(results[i].verdict), claim.text, first.measure, first.required);
    for (std::size_t k = 0; k < parts.size(); ++k)
      put("    {:<10} {}\n", word_for(results[i].parts[k].verdict), part_text(campaign, parts[k], results[i].parts[k]));
  }
}

std::string headline(const campaign::CampaignPlan& plan) {
  return fmt::format("{}: {} ({} × {}) of {}{}", plan.title, counted(plan.runs.size(), "run"),
                     counted(plan.groups.size(), "group"), counted(plan.seeds.size(), "seed"),
                     plan.until_solved ? "up to " : "", counted(plan.trials, "trial"));
}

}  // namespace

void print_plan(const campaign::CampaignPlan& plan) {
  put("{}\n", headline(plan));
  for (const CampaignGroup& group : plan.groups) put("  {}\n", label_of(group));
  for (const auto& [name, reason] : plan.missing) put("  missing: {}\n", reason);
  if (!plan.claims.empty()) put("Claims\n");
  for (const campaign::PlannedClaim& claim : plan.claims) put("  {}\n", claim.claim.text);
}

void CampaignConsole::started(const Campaign& campaign, Index at_once) {
  plan_ = campaign.plan;
  at_once_ = std::max<Index>(1, at_once);
  ended_ = campaign.count(RunState::done);
  failed_ = campaign.count(RunState::failed);
  for (const RunOutcome& run : campaign.runs)
    left_.push_back(run.state == RunState::unfinished ? plan_.trials - run.done() : 0);
  if (share_.of == 1)
    line_.print(fmt::format("{} in {}", headline(plan_), folder_));
  else
    line_.print(fmt::format("{}: share {} of {}, {} of {} in {}", plan_.title, share_.number, share_.of,
                            counted(plan_.runs.size(), "run"), counted(plan_.trials, "trial"), folder_));
  for (const std::string& remark : campaign.remarks()) line_.print(remark);
  if (ended_ > 0) line_.print(fmt::format("{} of {} done already", ended_, counted(plan_.runs.size(), "run")));
}

void CampaignConsole::run_started(std::size_t run, Index done) {
  running_[run] = {Clock::now(), Clock::now(), done, done + 1};
}

void CampaignConsole::progress(std::size_t run, Index trial, const Progress& progress) {
  Running& state = running_[run];
  if (trial != state.trial) state.trial_begin = Clock::now();
  state.trial = trial;
  if (!line_.is_due()) return;
  std::string line = fmt::format("{}/{} runs", ended_, plan_.runs.size());
  if (failed_ > 0) line += fmt::format(", {} failed", failed_);
  if (const auto left = seconds_left())
    line += fmt::format("  {}about {} left", plan_.until_solved ? "at most " : "", duration_text(*left));
  line += fmt::format("  {}: trial {}/{} {} {:.0f} %", name_of(run), trial, plan_.trials, progress.phase,
                      100 * progress.done);
  line_.show(line);
}

void CampaignConsole::run_ended(std::size_t run, const RunOutcome& outcome) {
  const auto found = running_.find(run);
  double seconds = 0;
  if (found != running_.end()) {
    Cost& spent = spent_[kind_of(run)];
    seconds = Seconds(Clock::now() - found->second.begin).count();
    spent.seconds += seconds;
    spent.trials += outcome.done() - found->second.before;
    running_.erase(found);
  }
  left_[run] = 0;
  ++(outcome.state == RunState::failed ? failed_ : ended_);
  line_.print(fmt::format("[{}/{}] {}  {}  in {}", ended_ + failed_, plan_.runs.size(), name_of(run),
                          outcome_text(outcome, plan_.trials), duration_text(seconds)));
}

void CampaignConsole::finished(const Campaign& campaign) {
  line_.clear();
  if (share_.of > 1) {
    print_failures(campaign);
    put("The same command without --share, when all shares have ended, writes the tables\n");
    return;
  }
  print_groups(campaign);
  print_failures(campaign);
  print_claims(campaign);
  put("\nThe tables: {0}/campaign.csv, {0}/summary.json\n", folder_);
}

std::string CampaignConsole::name_of(std::size_t run) const {
  const campaign::PlannedRun& planned = plan_.runs[run];
  return fmt::format("{} seed {}", label_of(plan_.groups[planned.group]), planned.spec.seed);
}

std::string CampaignConsole::kind_of(std::size_t run) const {
  const CampaignGroup& group = plan_.groups[plan_.runs[run].group];
  return group.learner + " " + group.variant;
}

std::map<std::string, CampaignConsole::Cost> CampaignConsole::costs() const {
  std::map<std::string, Cost> costs = spent_;
  for (const auto& [run, state] : running_) {
    const Index trials = state.trial - 1 - state.before;
    if (trials <= 0) continue;
    Cost& cost = costs[kind_of(run)];
    cost.seconds += Seconds(state.trial_begin - state.begin).count();
    cost.trials += trials;
  }
  return costs;
}

/// Trials are taken to last as long as those before of the same learner and variant; as all, before it has any. A run
/// that takes longer than that says nothing of those that have not begun.
std::optional<double> CampaignConsole::seconds_left() const {
  const std::map<std::string, Cost> known = costs();
  Cost all;
  for (const auto& [kind, cost] : known) {
    all.seconds += cost.seconds;
    all.trials += cost.trials;
  }
  if (all.trials == 0) return std::nullopt;
  double seconds = 0;
  for (std::size_t run = 0; run < left_.size(); ++run) {
    const auto found = known.find(kind_of(run));
    const Cost& cost = found != known.end() && found->second.trials > 0 ? found->second : all;
    double of_run = static_cast<double>(left_[run]) * cost.seconds / static_cast<double>(cost.trials);
    if (const auto state = running_.find(run); state != running_.end())
      of_run -= Seconds(Clock::now() - state->second.begin).count();
    seconds += std::max(0.0, of_run);
  }
  return seconds / static_cast<double>(at_once_);
}

}  // namespace rehearse::apps
