#include "rehearse/learners/black_drops/policy_search.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "rehearse/core/stopwatch.hpp"
#include "rehearse/learners/black_drops/gradient_search.hpp"
#include "rehearse/learners/black_drops/simulated_return.hpp"
#include "rehearse/optim/box.hpp"

namespace rehearse::learners::black_drops {
namespace {

using Box = std::vector<Interval>;

Box box_of(const policy::Policy& policy, const SearchOptions& options) {
  return Box(static_cast<std::size_t>(policy.parameters()), interval_of(policy, options));
}

/// The options with step sizes that are to the policy's box as they were to the options'. Where the box is the policy's
/// own, as that of a gait, no descent begins near the centre: policies are not smoother there.
SearchOptions in_box_of(const policy::Policy& policy, SearchOptions options) {
  const Interval interval = interval_of(policy, options);
  const double scale = (interval.high - interval.low) / (2 * options.box);
  options.race.sigma *= scale;
  options.race.start_sigma *= scale;
  if (policy.box()) options.race.near_centre = 1;
  return options;
}

/// True if a search climbs along gradients. Not where limits must be kept, which have no gradient.
bool climbs(const SearchProblem& problem, const SearchOptions& options) {
  return needs_derivatives(options.method) && !options.constrained && problem.doubted.empty();
}

bool races(const SearchProblem& problem, const SearchOptions& options) {
  return options.method != Method::restarts && !(options.method == Method::gradient && climbs(problem, options));
}

/// Evaluations, most of them at most.
Index budget(const SearchProblem& problem, const SearchOptions& options) {
  if (options.method == Method::restarts) return options.restarts.max_evaluations;
  Index all = races(problem, options) ? options.race.max_evaluations : 0;
  if (climbs(problem, options)) all += options.gradient.steps * options.gradient.particles;
  return all;
}

/// The first of each, the second of each, …: a step that is too long may leave a good policy for a worse one.
std::vector<Vector> in_turn(std::vector<Vector> first, const std::vector<Vector>& second) {
  for (std::size_t i = 0; i < second.size(); ++i)
    first.insert(first.begin() + static_cast<std::ptrdiff_t>(std::min(2 * i + 1, first.size())), second[i]);
  return first;
}

/// Good policies, best first, by the method asked for.
std::vector<Vector> find(SimulatedReturn& objective, const std::vector<Vector>& starts, const Box& box,
                         const SearchProblem& problem, const SearchOptions& options, const StreamKey& key,
                         const optim::SearchListener& listener) {
  std::vector<Vector> found;
  Index evaluations = 0;
  if (options.method == Method::restarts) {
    const Vector start = starts.empty() ? random_policy(problem.policy, options, key) : starts.front();
    auto result = optim::maximise(std::ref(objective), start, box, options.restarts, key, listener);
    for (optim::Candidate& candidate : result.candidates) found.push_back(std::move(candidate.x));
  }
  if (races(problem, options)) {
    auto result = optim::race(std::ref(objective), {box, starts}, options.race, key, problem.evaluator, listener);
    for (optim::Contender& contender : result.contenders) found.push_back(std::move(contender.x));
    evaluations = result.evaluations;
  }
  if (!climbs(problem, options)) return found;
  const auto count = [&, before = objective.rollouts()](Index, double best) {
    if (listener) listener(evaluations + objective.rollouts() - before, best);
  };
  const std::vector<Vector>& from = found.empty() ? starts : found;
  auto climbed = search_by_gradient(objective, problem.policy, {box.front(), from}, options.gradient, key, count);
  return in_turn(std::move(climbed), found);
}

/// The number of finalists: with limits all, since any of the policies found may be the only safe one.
Index finalists_of(const std::vector<Vector>& found, const SearchProblem& problem, const SearchOptions& options) {
  const auto all = static_cast<Index>(found.size());
  return problem.task.limits.empty() ? std::min(options.finalists, all) : all;
}

SearchResult result_of(const Vector& theta, Measurement measured, const Task& task) {
  const double too_much = excess(measured.risks, task.limits);
  return {.theta = theta, .predicted_return = measured.mean, .risks = std::move(measured.risks), .excess = too_much};
}

/// Compares the finalists and the starts by some rollouts of each; the best is the result, other finds its runners-up.
SearchResult select(const std::vector<Vector>& found, const std::vector<Vector>& starts, SimulatedReturn& objective,
                    const SearchProblem& problem, const SearchOptions& options) {
  const Index finalists = finalists_of(found, problem, options);
  Matrix Theta(found.front().size(), finalists + static_cast<Index>(starts.size()));
  for (Index i = 0; i < Theta.cols(); ++i)
    Theta.col(i) = i < finalists ? found[static_cast<std::size_t>(i)] : starts[static_cast<std::size_t>(i - finalists)];
  const auto measured = objective.measure(Theta, objective.next(), comparisons(problem, options));
  std::vector<SearchResult> compared;
  for (Index i = 0; i < Theta.cols(); ++i)
    compared.push_back(result_of(Theta.col(i), measured[static_cast<std::size_t>(i)], problem.task));
  const auto best = std::min_element(compared.begin(), compared.end(), better) - compared.begin();
  SearchResult result = compared[static_cast<std::size_t>(best)];
  result.highest_return = result.predicted_return;
  for (const SearchResult& other : compared)
    result.highest_return = std::max(result.highest_return, other.predicted_return);
  for (Index i = 0; i < static_cast<Index>(found.size()); ++i)
    if (i >= finalists || i != best) result.runners_up.push_back(found[static_cast<std::size_t>(i)]);
  return result;
}

}  // namespace

Interval interval_of(const policy::Policy& policy, const SearchOptions& options) {
  return policy.box().value_or(Interval{-options.box, options.box});
}

bool better(const SearchResult& a, const SearchResult& b) {
  return a.excess != b.excess ? a.excess < b.excess : a.predicted_return > b.predicted_return;
}

SearchResult search_policy(const SearchProblem& problem, const std::vector<Vector>& starts,
                           const SearchOptions& options, const StreamKey& key) {
  SimulatedReturn objective(problem, options, key);
  const Stopwatch watch;
  const Index most = budget(problem, options);
  const auto report = [&](Index evaluations, double best) {
    if (!problem.progress) return;
    problem.progress({.phase = "search",
                      .done = static_cast<double>(evaluations) / static_cast<double>(most),
                      .best = best,
                      .rollouts = objective.rollouts(),
                      .rollouts_per_s = watch.per_s(objective.rollouts())});
  };
  const Box box = box_of(problem.policy, options);
  StreamKey candidates = key;
  candidates.purpose = Purpose::search;
  const std::vector<Vector> found =
      find(objective, starts, box, problem, in_box_of(problem.policy, options), candidates, report);
  SearchResult result = select(found, starts, objective, problem, options);
  result.rollouts = objective.rollouts();
  result.failed_rollouts = objective.failed();
  return result;
}

SearchResult judge(const SearchProblem& problem, const Vector& theta, const SearchOptions& options,
                   const StreamKey& key) {
  SimulatedReturn objective(problem, options, key);
  SearchResult result =
      result_of(theta, objective.measure(theta, 0, comparisons(problem, options)).front(), problem.task);
  result.rollouts = objective.rollouts();
  result.failed_rollouts = objective.failed();
  return result;
}

SolvingRates solving_rates(const SearchProblem& problem, const std::vector<Vector>& policies,
                           const SearchOptions& options, const StreamKey& key) {
  SolvingRates all{.rates = Vector::Zero(static_cast<Index>(policies.size()))};
  if (!problem.task.solved) return all;
  const Index rollouts = comparisons(problem, options);
  const auto models = static_cast<Index>(problem.doubted.size());
  std::vector<Index> solved(policies.size()), failed(policies.size());
  const auto simulate = [&](const dynamics::DynamicsModel& model, Index count, const StreamKey& stream, Index first,
                            Index last) {
    Matrix Theta((last - first) * count, problem.policy.parameters());
    for (Index j = first; j < last; ++j)
      Theta.middleRows((j - first) * count, count).rowwise() = policies[static_cast<std::size_t>(j)].transpose();
    rollout::Episodes episodes;
    rollout::simulate_episodes({model, problem.policy, problem.task, stream, options.simulate}, Theta,
                               {.period = count}, episodes, problem.evaluator);
    Episode episode;
    for (Index i = 0; i < episodes.rows(); ++i) {
      const auto j = static_cast<std::size_t>(first + i / count);
      if (episodes.failed[static_cast<std::size_t>(i)]) {
        ++failed[j];
        continue;
      }
      episodes.copy(i, episode);
      solved[j] += problem.task.solved(episode);
    }
  };
  const Index most =
      rollout::groups_of_chunk(all.rates.size(), rollouts, 1, rollout::rows_at_once(problem.model, problem.task));
  problem.evaluator.for_each((all.rates.size() + most - 1) / most, [&](Index c) {
    const Index first = c * most, last = std::min(first + most, all.rates.size());
    if (models == 0) simulate(problem.model, rollouts, key, first, last);
    for (Index m = 0; m < std::min(models, rollouts); ++m) {
      StreamKey stream = key;
      stream.descent = static_cast<std::uint64_t>(m) + 1;
      simulate(*problem.doubted[static_cast<std::size_t>(m)], (rollouts - m + models - 1) / models, stream, first,
               last);
    }
  });
  for (std::size_t j = 0; j < policies.size(); ++j)
    all.rates(static_cast<Index>(j)) = static_cast<double>(solved[j]) / static_cast<double>(rollouts);
  all.rollouts = rollouts * all.rates.size();
  all.failed = std::accumulate(failed.begin(), failed.end(), Index{0});
  return all;
}

Vector random_policy(const policy::Policy& policy, const SearchOptions& options, StreamKey key) {
  key.purpose = Purpose::random_policy;
  return optim::uniform_point(box_of(policy, options), 1, key);
}

}  // namespace rehearse::learners::black_drops
