#include "rehearse/learners/black_drops/trial_searches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rehearse::learners::black_drops {
namespace {

constexpr double kMeans = 0.1;  // weight of solving the task in the means, beside the rate of simulated episodes

/// Particles of one policy hardly differ there.
SearchOptions in_means(SearchOptions options) {
  constexpr Index kFewer = 4;
  options.simulate.sample = false;
  options.gradient.particles = std::max(options.gradient.particles / kFewer, Index{1});
  return options;
}

/// The task with a bonus for every episode that solves it.
Task with_bonus(Task task, double bonus) {
  task.episode_reward = [of_task = std::move(task.episode_reward), solved = task.solved,
                         bonus](const Episode& episode) {
    return (of_task ? of_task(episode) : 0) + (solved(episode) ? bonus : 0);
  };
  return task;
}

/// Twice the rollouts of another search, for descents that begin at the starts alone.
SearchOptions for_safety(SearchOptions options, std::size_t starts) {
  constexpr Index kRollouts = 8, kFewer = 4;
  options.constrained = true;
  options.particles *= kRollouts;
  options.race.descents = std::max(static_cast<Index>(starts), Index{1});
  options.race.max_evaluations = std::max(options.race.max_evaluations / kFewer, 2 * options.race.descents);
  options.restarts.max_evaluations =
      std::max(options.restarts.max_evaluations / kFewer, options.restarts.reserved() + 1);
  options.safety.rollouts = std::max(options.safety.rollouts / kRollouts, Index{1});
  options.selection = std::max(options.selection / kRollouts, Index{1});
  return options;
}

}  // namespace

TrialSearches::TrialSearches(const SearchProblem& problem, const SearchOptions& options, const StreamKey& trial,
                             std::uint64_t first)
    : problem_(problem), options_(options), trial_(trial), first_(first) {}

SearchResult TrialSearches::search(const std::vector<Vector>& starts, Index i) {
  return counted(search_policy(problem_, starts, options_, key(Stage::search, i)));
}

SearchResult TrialSearches::search_solving(const std::vector<Vector>& starts, double bonus, Index i) {
  const Task task = with_bonus(problem_.task, bonus);
  SearchOptions options = options_;
  if (needs_derivatives(options.method)) options.method = Method::race;  // a bonus has none
  const ProgressSink without_best = [this](Progress progress) {
    progress.best = kNaN;  // with the bonus it is no return
    problem_.progress(progress);
  };
  const SearchProblem problem{
      problem_.model,  problem_.policy, task, problem_.evaluator, problem_.progress ? without_best : problem_.progress,
      problem_.doubted};
  SearchResult found = counted(search_policy(problem, starts, options, key(Stage::solving_search, i)));
  SearchResult judged = judge(found.theta);
  judged.runners_up = std::move(found.runners_up);
  judged.rollouts += found.rollouts;
  judged.failed_rollouts += found.failed_rollouts;
  return judged;
}

SearchResult TrialSearches::search_safe(const std::vector<Vector>& starts, Index i) {
  return counted(search_policy(problem_, starts, for_safety(options_, starts.size()), key(Stage::safe_search, i)));
}

SearchResult TrialSearches::judge(const Vector& theta) {
  return counted(black_drops::judge(problem_, theta, options_, key(Stage::judging)));
}

SearchResult TrialSearches::judge_anew(const Vector& theta) {
  SearchResult judged = counted(black_drops::judge(problem_, theta, options_, key(Stage::judging, 1)));
  if (has_limits() && can_tell_solved()) judged.solving = solving({theta}, 1)(0);
  return judged;
}

bool TrialSearches::is_sure_of(const Vector& theta) {
  constexpr double kSame = 1e-3;
  const double uncertain = judge(theta).predicted_return;
  const SearchOptions means = in_means(options_);
  const double mean = counted(black_drops::judge(problem_, theta, means, key(Stage::judging))).predicted_return;
  return within(kSame, uncertain, mean) && within(kSame, mean, uncertain);
}

std::optional<SearchResult> TrialSearches::best_that_solves(const SearchResult& found) {
  if (!can_tell_solved()) return std::nullopt;
  std::vector<Vector> policies = found.runners_up;
  policies.insert(policies.begin(), found.theta);
  const Vector rates = solving(policies, 0);
  std::vector<Index> order(policies.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, [&](Index a, Index b) { return rates(a) > rates(b); });
  for (const Index i : order) {
    if (rates(i) == 0) break;
    SearchResult judged = judge(policies[static_cast<std::size_t>(i)]);
    if (judged.excess > found.excess) continue;
    judged.solving = rates(i);
    return judged;
  }
  return std::nullopt;
}

Vector TrialSearches::solving(const std::vector<Vector>& policies, Index number) {
  SearchOptions means = in_means(options_);
  means.simulate.measurement_noise = 0;
  means.selection = means.safety.rollouts = 1;
  const auto rates = [&](const SearchOptions& options, Stage stage) {
    SolvingRates found = solving_rates(problem_, policies, options, key(stage, number));
    rollouts_ += found.rollouts;
    failed_rollouts_ += found.failed;
    return std::move(found.rates);
  };
  Vector all = rates(options_, Stage::solving);
  all += kMeans * rates(means, Stage::mean_solving);
  return all;
}

StreamKey TrialSearches::key(Stage stage, Index search) const {
  StreamKey key = trial_;
  key.stage = stage;
  key.search = first_ + static_cast<std::uint64_t>(search);
  return key;
}

SearchResult TrialSearches::counted(SearchResult found) {
  rollouts_ += found.rollouts;
  failed_rollouts_ += found.failed_rollouts;
  return found;
}

bool within(double tolerance, double expected, double predicted) {
  return predicted >= expected - tolerance * std::abs(expected);
}

}  // namespace rehearse::learners::black_drops
