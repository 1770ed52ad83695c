#include "rehearse/learners/black_drops/choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace rehearse::learners::black_drops {
namespace {

constexpr double kNearlyAll = 0.05;     // fraction of the promised return that a safe policy may lack
constexpr std::size_t kSafeStarts = 8;  // policies near which a safe one is looked for
constexpr double kAgain = 0.001;        // fraction of the return by which searches that agree may differ
constexpr double kOften = 0.5;          // that a task is solved so surely makes a trial worth while
constexpr double kNearlyAlways = 0.9;   // and this ends the search: less was solved by few trials

bool is_better(const SearchResult& found, const Choice& choice) {
  return better(found, {.predicted_return = choice.predicted_return, .excess = choice.excess});
}

/// Searches until a policy is found that often solves the task, and whose predicted return is within a tolerance of the
/// highest one, which is the choice. Returns the policy that solves it most often, if one does.
std::optional<SearchResult> search_for_solving(TrialSearches& searches, SearchResult found, const SearchAgain& again,
                                               const Retry& limits, Choice& choice) {
  std::optional<SearchResult> solving;
  if (!searches.can_tell_solved()) return solving;
  for (Index i = 1;; ++i) {
    if (auto judged = searches.best_that_solves(found))
      if (judged->excess <= choice.excess && (!solving || judged->solving > solving->solving))
        solving = std::move(judged);
    if (solving && solving->solving >= kNearlyAlways &&
        within(limits.tolerance, choice.predicted_return, solving->predicted_return))
      break;
    if (i > limits.searches) break;
    std::vector<Vector> best = {choice.theta};
    if (solving) best.insert(best.begin(), solving->theta);
    found = again(i, best);
    if (is_better(found, choice)) choice.take(found);
  }
  if (solving && solving->excess > choice.excess) solving.reset();  // a later search found a safer one
  choice.none_solves = !solving;
  return solving;
}

}  // namespace

bool often_solves(const Choice& choice) { return choice.solving >= kOften; }

void prefer_safe(TrialSearches& searches, const SafetyOptions& safety, SearchResult& found, Choice& choice) {
  if (!searches.has_limits()) return;
  double promised = found.highest_return;
  for (Index i = 0; i < safety.searches; ++i) {
    if (choice.excess == 0 && within(kNearlyAll, promised, choice.predicted_return)) return;
    std::vector<Vector> starts = {choice.theta};
    for (const Vector& other : found.runners_up)
      if (starts.size() < kSafeStarts) starts.push_back(other);
    SearchResult more = searches.search_safe(starts, i);
    promised = std::max(promised, more.highest_return);
    if (!is_better(more, choice)) continue;
    choice.take(more);
    found = std::move(more);
  }
}

void prefer_solving_where_sure(TrialSearches& searches, const SearchResult& found, const SearchAgain& again,
                               const Retry& retry, Choice& choice) {
  if (retry.searches == 0) return;
  if (const auto solving = search_for_solving(searches, found, again, retry, choice)) choice.take(*solving);
}

void prefer_solving_where_uncertain(TrialSearches& searches, const SearchResult& found, const Retry& retry,
                                    Choice& choice) {
  const double tolerance = retry.uncertain_tolerance;
  if (tolerance == 0) return;
  const auto again = [&](Index i, const std::vector<Vector>& best) {
    return searches.search_solving(best, std::abs(choice.predicted_return), i);
  };
  Retry limits = retry;
  limits.tolerance = tolerance;
  const auto solving = search_for_solving(searches, found, again, limits, choice);
  if (solving && within(tolerance, choice.predicted_return, solving->predicted_return)) choice.take(*solving);
}

void prefer_found_again(TrialSearches& searches, const Retry& retry, Choice& choice) {
  if (searches.can_tell_solved() || retry.searches == 0 || !searches.is_sure_of(choice.theta)) return;
  for (Index i = 1; i <= retry.searches; ++i) {
    const SearchResult found = searches.search({}, i);
    const double before = choice.predicted_return;
    if (is_better(found, choice)) choice.take(found);
    if (within(kAgain, before, found.predicted_return) && within(kAgain, found.predicted_return, before)) return;
  }
}

void prefer_new(TrialSearches& searches, const std::vector<Vector>& tried, const SearchResult& found,
                const Retry& retry, Choice& choice) {
  const auto was_tried = [&](const Vector& policy) {
    return std::ranges::any_of(tried, [&](const Vector& old) { return old.size() == policy.size() && old == policy; });
  };
  if (retry.uncertain_tolerance == 0 || often_solves(choice) || !was_tried(choice.theta)) return;
  std::optional<SearchResult> best;
  for (const Vector& policy : found.runners_up) {
    if (was_tried(policy)) continue;
    SearchResult judged = searches.judge(policy);
    if (judged.excess > choice.excess) continue;
    if (!best || judged.predicted_return > best->predicted_return) best = std::move(judged);
  }
  if (!best) return;
  if (within(retry.uncertain_tolerance, choice.predicted_return, best->predicted_return) ||
      searches.is_sure_of(choice.theta))
    choice.take(*best);
}

}  // namespace rehearse::learners::black_drops
