#include "rehearse/study/hints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/study/log_model.hpp"
#include "rehearse/study/mean_ratio.hpp"

namespace rehearse::study {
namespace {

constexpr double kMuchBetter = 0.8;  // errors, of those as the logs are read
constexpr double kSure = 2;          // deviations of a zero that is off
constexpr Index kMostDelay = 10;     // control steps
constexpr std::size_t kMostLogs = 4;
constexpr double kRounding = 1e-12;  // of errors in any unit: there is nothing to explain
constexpr Index kStarts = 50;        // of predictions in a log

/// The log as if actions acted so many steps later. The actions before its beginning, or behind its end, are unknown.
Episode late(const Episode& log, Index steps) {
  const Index left = log.steps() - std::abs(steps);
  Episode part = log.part(std::max<Index>(steps, 0), left);
  part.actions = log.actions.middleRows(std::max<Index>(-steps, 0), left);
  return part;
}

class HintFinder {
 public:
  HintFinder(const std::vector<Episode>& logs, const Task& task, ZeroProblem problem, const Evaluator& evaluator)
      : task_(task), problem_(std::move(problem)), evaluator_(evaluator) {
    problem_.starts = kStarts;
    for (const Episode& log : logs)
      if (logs_.size() < kMostLogs && log.steps() >= problem_.horizon + kMostDelay) logs_.push_back(log);
  }

  std::vector<Hint> find() {
    if (logs_.empty()) return {};
    as_read_ = errors_left(logs_, problem_, evaluator_);
    if (as_read_.maxCoeff() < kRounding) return {};
    std::vector<Hint> all = {zeros(), delay()};
    for (Index a = 0; a < task_.action_size(); ++a) all.push_back(negated(a));
    std::erase_if(all, [](const Hint& hint) { return !(hint.errors < kMuchBetter); });
    std::ranges::stable_sort(all, {}, &Hint::errors);
    return all;
  }

 private:
  /// The zeros of positions, which are states that have a rate.
  Hint zeros() const {
    ZeroProblem problem = problem_;
    std::vector<Index> more;
    for (Index s = 0; s < task_.state_size(); ++s)
      if (!task_.states[static_cast<std::size_t>(s)].rate.empty() && !std::ranges::count(problem.states, s))
        more.push_back(s);
    if (more.empty()) return {};
    problem.states.insert(problem.states.end(), more.begin(), more.end());
    const Zeros found = find_zeros(logs_, problem, evaluator_);
    Hint hint{.errors = mean_ratio(found.left, as_read_)};
    for (const Index s : more)
      if ((found.offsets.col(s).cwiseAbs().array() > kSure * found.deviations.col(s).array()).any())
        hint.states.push_back(s);
    return hint.states.empty() ? Hint{} : hint;
  }

  /// All delays are tried: errors may rise between the first step and the right one.
  Hint delay() const {
    Hint best;
    for (const Index direction : {1, -1})
      for (Index k = 1; k <= kMostDelay; ++k) {
        const double errors = errors_of([&](const Episode& log) { return late(log, k * direction); });
        if (errors < best.errors) best = {.delay_s = static_cast<double>(k * direction) * task_.dt_s, .errors = errors};
      }
    return best;
  }

  /// None where an action would be out of its bounds, for which no simulator is made.
  Hint negated(Index action) const {
    const Interval& bounds = task_.actions[static_cast<std::size_t>(action)].bounds;
    for (const Episode& log : logs_)
      if (-log.actions.col(action).maxCoeff() < bounds.low || -log.actions.col(action).minCoeff() > bounds.high)
        return {};
    return {.negated = action, .errors = errors_of([&](Episode log) {
                                 log.actions.col(action) *= -1;
                                 return log;
                               })};
  }

  /// The errors if the logs were read so.
  template <class Read>
  double errors_of(Read read) const {
    std::vector<Episode> all;
    for (const Episode& log : logs_) all.push_back(read(log));
    return mean_ratio(errors_left(all, problem_, evaluator_), as_read_);
  }

  std::vector<Episode> logs_;
  const Task& task_;
  ZeroProblem problem_;
  const Evaluator& evaluator_;
  Vector as_read_;
};

std::string fault(const Hint& hint, const Task& task) {
  if (hint.negated >= 0)
    return fmt::format("the action {} seems to have the other sign",
                       task.actions[static_cast<std::size_t>(hint.negated)].name);
  if (hint.states.empty())
    return fmt::format("actions seem to act {:.3g} s {} than their rows say (read.action_delay_s of `identify`{})",
                       std::abs(hint.delay_s), hint.delay_s > 0 ? "later" : "earlier",
                       hint.delay_s > 0 ? "; to learn, delay_s of the action" : "");
  std::vector<std::string> names;
  for (const Index s : hint.states) names.push_back(task.states[static_cast<std::size_t>(s)].name);
  return fmt::format("the zero of {} seems to be off (zeros={} of `identify`)", fmt::join(names, " and of "),
                     fmt::join(names, ","));
}

}  // namespace

std::string line_of(const Hint& hint, const Task& task) {
  return fmt::format("{}: short forecasts would have {:.2f} times the errors", fault(hint, task), hint.errors);
}

std::vector<Hint> find_hints(const std::vector<Episode>& logs, const Task& task, const prior::Prior& prior,
                             const Options& options, const Evaluator& evaluator) {
  return HintFinder(logs, task, zero_problem(prior, task, options), evaluator).find();
}

}  // namespace rehearse::study
