#include "rehearse/campaign/claims.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/statistics/intervals.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::campaign {
namespace {

std::string name_of(const Measure& measure) {
  if (measure.metric == Metric::total_reward) return fmt::format("return of trial {}", measure.trial);
  if (measure.metric == Metric::best_return) return fmt::format("best return until trial {}", measure.trial);
  return "trial of first success";
}

std::string name_of_success(const Measure& measure) {
  if (!measure.success_return) return fmt::format("solved by trial {}", measure.trial);
  return fmt::format("return of {} reached by trial {}", *measure.success_return, measure.trial);
}

std::optional<Index> first_success(const RunOutcome& run, const Measure& measure) {
  if (!measure.success_return) return run.first_success(measure.trial);
  for (Index trial = 1; trial <= std::min(measure.trial, run.done()); ++trial)
    if (run.best_return(trial) >= *measure.success_return) return trial;
  return std::nullopt;
}

/// The value of a measure; none if the run has not come so far, even if it has succeeded: early ones alone would be a
/// biased choice. A run that failed has no success from there on, but no return either.
std::optional<double> value_of(const RunOutcome& run, const Measure& measure) {
  if (measure.metric == Metric::first_success) {
    if (!run.decided(measure.trial)) return std::nullopt;
    return static_cast<double>(first_success(run, measure).value_or(measure.trial + 1));
  }
  const auto row = run.row_of(measure.trial);
  if (!row) return std::nullopt;
  return measure.metric == Metric::total_reward ? run.returns[*row] : run.best_return(measure.trial);
}

/// The verdict: the interval is at or above a threshold (`strict`: above it), below it, or neither.
Verdict at_or_above(const Interval& interval, double threshold, bool strict = false) {
  if (strict ? interval.low > threshold : interval.low >= threshold) return Verdict::pass;
  if (strict ? interval.high <= threshold : interval.high < threshold) return Verdict::fail;
  return Verdict::undecided;
}

Verdict at_or_below(const Interval& interval, double threshold) {
  return at_or_above({-interval.high, -interval.low}, -threshold);
}

Verdict both(Verdict a, Verdict b) {
  if (a == Verdict::fail || b == Verdict::fail) return Verdict::fail;
  return a == Verdict::pass ? b : a;
}

/// Judges one part of a claim.
class Judge {
 public:
  Judge(const Campaign& campaign, const PlannedClaim& planned, const ClaimPart& part)
      : campaign_(campaign), planned_(planned), part_(part) {}

  PartResult result() {
    const Claim& claim = planned_.claim;
    if (claim.success) judge_success(*claim.success);
    if (claim.comparison) judge_comparison(*claim.comparison);
    if (claim.median) judge_median(*claim.median);
    if (result_.verdict == Verdict::undecided) result_.reason = why_undecided();
    result_.required = fmt::format("{}", fmt::join(required_, ", "));
    return std::move(result_);
  }

 private:
  std::size_t seeds() const { return campaign_.plan.seeds.size(); }

  std::optional<double> value(std::size_t group, std::size_t seed, const Measure& measure) {
    const RunOutcome& run = campaign_.outcome(group, seed);
    const bool needs_solved = measure.metric == Metric::first_success && !measure.success_return;
    for (const auto& solved : run.solved) cannot_say_ = cannot_say_ || (needs_solved && !solved);
    const auto value = value_of(run, measure);
    if (!value && run.state == RunState::failed) ++failed_;
    return value;
  }

  std::vector<double> values(const Measure& measure) {
    std::vector<double> values;
    for (std::size_t group : part_.groups)
      for (std::size_t seed = 0; seed < seeds(); ++seed)
        if (const auto number = value(group, seed, measure)) values.push_back(*number);
    result_.of = static_cast<Index>(part_.groups.size() * seeds());
    return values;
  }

  /// The advantage of the runs over those that they are compared with, by seed.
  std::vector<double> differences(const Measure& measure) {
    const double sign = measure.metric == Metric::first_success ? -1 : 1;
    std::vector<double> differences;
    for (std::size_t seed = 0; seed < seeds(); ++seed) {
      const Index failed_before = failed_;
      std::vector<double> by_group;
      for (std::size_t i = 0; i < part_.against.size(); ++i) {
        const auto ours = value(part_.groups[i], seed, measure), theirs = value(part_.against[i], seed, measure);
        if (ours && theirs) by_group.push_back(sign * (*ours - *theirs));
      }
      if (!by_group.empty() && by_group.size() == part_.groups.size())
        differences.push_back(statistics::mean(by_group));
      failed_ = std::min(failed_, failed_before + 1);  // pairs, not their runs
    }
    result_.of = part_.against.empty() ? 0 : static_cast<Index>(seeds());
    return differences;
  }

  void show(const std::string& measure, std::size_t runs, double estimate, const Interval& interval) {
    result_.measure = measure;
    result_.runs = static_cast<Index>(runs);
    result_.estimate = estimate;
    result_.interval = interval;
  }

  /// Adds a requirement in words, with its verdict. The part's verdict is that of all requirements together.
  void require(std::string required, Verdict verdict) {
    if (planned_.claim.observed && !required.starts_with("count")) required += " observed";
    required_.push_back(std::move(required));
    result_.verdict = both(required_.size() > 1 ? result_.verdict : Verdict::pass, verdict);
  }
  Interval deciding() const {
    const double estimate = result_.estimate;
    return planned_.claim.observed ? Interval{estimate, estimate} : result_.interval;
  }
  bool complete() const { return result_.of > 0 && result_.runs == result_.of && !cannot_say_; }
  Verdict once_complete(Verdict verdict) const { return complete() ? verdict : Verdict::undecided; }

  void judge_success(const SuccessClaim& wanted) {
    const std::vector<double> first = values(wanted.measure);
    const auto n = static_cast<Index>(first.size());
    const Index count = std::count_if(first.begin(), first.end(),
                                      [&](double trial) { return trial <= static_cast<double>(wanted.measure.trial); });
    show(name_of_success(wanted.measure), first.size(), static_cast<double>(count) / static_cast<double>(n),
         statistics::rate_interval(count, n));
    result_.count = count;
    if (const auto rate = wanted.at_least_rate)
      require(fmt::format("rate ≥ {}", *rate), once_complete(at_or_above(deciding(), *rate)));
    if (const auto rate = wanted.at_most_rate)
      require(fmt::format("rate ≤ {}", *rate), once_complete(at_or_below(deciding(), *rate)));
    // Counts are known as soon as the runs to come cannot change them.
    const auto low = static_cast<double>(count), high = static_cast<double>(count + result_.of - n);
    const bool can_say = result_.of > 0 && !cannot_say_;
    const Interval possible = can_say ? Interval{low, high} : Interval{-HUGE_VAL, HUGE_VAL};
    if (const auto runs = wanted.at_least_runs)
      require(fmt::format("count ≥ {}", *runs), at_or_above(possible, static_cast<double>(*runs)));
    if (const auto runs = wanted.at_most_runs)
      require(fmt::format("count ≤ {}", *runs), at_or_below(possible, static_cast<double>(*runs)));
  }

  void judge_comparison(const ComparisonClaim& wanted) {
    const std::vector<double> better = differences(wanted.measure);
    show(name_of(wanted.measure), better.size(), statistics::mean(better), statistics::mean_interval(better));
    const double threshold = -wanted.not_worse_by.value_or(0);
    const bool strict = !wanted.not_worse_by;
    require(fmt::format("difference {} {}", strict ? ">" : "≥", threshold == 0 ? 0 : threshold),
            once_complete(at_or_above(deciding(), threshold, strict)));
  }

  void judge_median(const MedianClaim& wanted) {
    const std::vector<double> all = values(wanted.measure);
    show(name_of(wanted.measure), all.size(), statistics::median(all), statistics::median_interval(all));
    if (wanted.at_least)
      require(fmt::format("median ≥ {}", *wanted.at_least), once_complete(at_or_above(deciding(), *wanted.at_least)));
    if (wanted.at_most)
      require(fmt::format("median ≤ {}", *wanted.at_most), once_complete(at_or_below(deciding(), *wanted.at_most)));
  }

  std::string why_undecided() const {
    if (!planned_.missing.empty()) return planned_.missing;
    const char* what = planned_.claim.comparison ? "pairs" : "runs";
    if (cannot_say_) return "the scenario cannot say what is solved";
    if (result_.runs < result_.of && failed_ > 0)
      return fmt::format("{} of {} {} without such a value, since runs failed", failed_, result_.of, what);
    if (result_.runs < result_.of) return fmt::format("{} of {} {} are done", result_.runs, result_.of, what);
    if (std::isinf(result_.interval.low)) return fmt::format("an interval needs 6 {}", what);
    return "the interval does not decide";
  }

  const Campaign& campaign_;
  const PlannedClaim& planned_;
  const ClaimPart& part_;
  PartResult result_;
  std::vector<std::string> required_;
  Index failed_ = 0;         // runs, or pairs of them, without a value, now and for ever
  bool cannot_say_ = false;  // the scenario has no test of success
};

ClaimResult judge_claim(const Campaign& campaign, const PlannedClaim& planned) {
  ClaimResult result{.verdict = Verdict::pass};
  for (const ClaimPart& part : planned.parts) {
    result.parts.push_back(Judge(campaign, planned, part).result());
    result.verdict = both(result.verdict, result.parts.back().verdict);
  }
  return result;
}

}  // namespace

const char* to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

std::vector<ClaimResult> judge(const Campaign& campaign) {
  std::vector<ClaimResult> results;
  for (const PlannedClaim& claim : campaign.plan.claims) results.push_back(judge_claim(campaign, claim));
  return results;
}

}  // namespace rehearse::campaign
