#include "rehearse/learners/black_drops/policy_search.hpp"

#include <algorithm>

#include "rehearse/core/stopwatch.hpp"

namespace rehearse::learners::black_drops {
namespace {

/// Simulated returns as an objective, and how many rollouts failed.
class SimulatedReturn {
 public:
  SimulatedReturn(const SearchProblem& problem, const SearchOptions& options, StreamKey key)
      : problem_(problem), options_(options), key_(key) {}

  void operator()(const ConstMatrixView& Theta, std::uint64_t first, Index samples, VectorView values) {
    const rollout::Simulated simulated =
        rollout::simulate({problem_.model, problem_.policy, problem_.task, key_, options_.simulate}, Theta,
                          {first, samples * options_.particles}, problem_.evaluator);
    values = simulated.returns.colwise().mean().transpose();
    rollouts_ += simulated.returns.size();
    next_ = std::max(next_, first + static_cast<std::uint64_t>(Theta.cols()));
    failed_ += simulated.failed;
  }

  std::uint64_t next() const { return next_; }  // the first candidate that no call has had
  Index rollouts() const { return rollouts_; }
  Index failed() const { return failed_; }

 private:
  const SearchProblem& problem_;
  const SearchOptions& options_;
  StreamKey key_;
  std::uint64_t next_ = 0;
  Index rollouts_ = 0, failed_ = 0;
};

using Box = std::vector<Interval>;

/// Of every number of θ.
Interval interval_of(const policy::Policy& policy, const SearchOptions& options) {
  return policy.box().value_or(Interval{-options.box, options.box});
}

/// With step sizes that are to the policy's box as they were to the options'.
SearchOptions in_box_of(const policy::Policy& policy, SearchOptions options) {
  const Interval interval = interval_of(policy, options);
  const double scale = (interval.high - interval.low) / (2 * options.box);
  options.race.sigma *= scale;
  options.race.start_sigma *= scale;
  return options;
}

/// Good policies, best first, by the method asked for.
std::vector<Vector> find(const optim::BatchObjective& objective, const std::vector<Vector>& starts, const Box& box,
                         const SearchProblem& problem, const SearchOptions& options, const StreamKey& key,
                         const optim::SearchListener& listener) {
  std::vector<Vector> found;
  if (options.method == Method::race) {
    auto result = optim::race(objective, {box, starts}, options.race, key, problem.evaluator, listener);
    for (optim::Contender& contender : result.contenders) found.push_back(std::move(contender.x));
  } else {
    const Vector start = starts.empty() ? random_policy(problem.policy, options, key) : starts.front();
    auto result = optim::maximise(objective, start, box, options.restarts, key, listener);
    for (optim::Candidate& candidate : result.candidates) found.push_back(std::move(candidate.x));
  }
  return found;
}

/// Compares the finalists and the starts by some rollouts of each; the best is the result, other finds its runners-up.
void select(std::vector<Vector> found, const std::vector<Vector>& starts, SimulatedReturn& objective,
            Index most_finalists, Index rollouts, SearchResult& result) {
  const auto finalists = std::min(most_finalists, static_cast<Index>(found.size()));
  Matrix Theta(found.front().size(), finalists + static_cast<Index>(starts.size()));
  for (Index i = 0; i < Theta.cols(); ++i)
    Theta.col(i) = i < finalists ? found[static_cast<std::size_t>(i)] : starts[static_cast<std::size_t>(i - finalists)];
  Vector values(Theta.cols());
  objective(Theta, objective.next(), rollouts, values);
  Index best = 0;
  result.predicted_return = values.maxCoeff(&best);
  result.theta = Theta.col(best);
  if (best < finalists) found.erase(found.begin() + best);
  result.runners_up = std::move(found);
}

}  // namespace

void SearchOptions::fields(FieldVisitor& v) {
  v.choice("method", method, "descents that compete, or one after the other", {"race", "restarts"},
           published("restarts"));
  v.number("box", box, "parameters of policies are in [−box, box], unless the policy has a box", between(1e-6, 1e6));
  v.integer("particles", particles, "rollouts of one evaluation", between(1, 1e6));
  v.group("simulate", simulate);
  v.group("race", race);
  v.group("restarts", restarts, kExpert);
  v.integer("finalists", finalists, "best policies found that are compared once more", between(1, 1e6), published(1));
  v.integer("selection", selection, "rollouts of each finalist; their mean is the predicted return", between(1, 1e6),
            published(1));
}

Index comparisons(const SearchProblem& problem, const SearchOptions& options) {
  const bool sure = !options.simulate.sample || problem.model.certain();
  const bool exact = options.simulate.measurement_noise == 0 || problem.model.measurement_std().isZero(0);
  return sure && exact && problem.task.start_std.isZero(0) ? 1 : options.selection;
}

SearchResult search_policy(const SearchProblem& problem, const std::vector<Vector>& starts,
                           const SearchOptions& options, const StreamKey& key) {
  SimulatedReturn objective(problem, options, key);
  const Stopwatch watch;
  const Index budget = options.method == Method::race ? options.race.max_evaluations : options.restarts.max_evaluations;
  const auto report = [&](Index evaluations, double best) {
    if (!problem.progress) return;
    problem.progress({.phase = "search",
                      .done = static_cast<double>(evaluations) / static_cast<double>(budget),
                      .best = best,
                      .rollouts = objective.rollouts(),
                      .rollouts_per_s = watch.per_s(objective.rollouts())});
  };
  const Box box(static_cast<std::size_t>(problem.policy.parameters()), interval_of(problem.policy, options));
  StreamKey candidates = key;
  candidates.purpose = Purpose::search;
  std::vector<Vector> found =
      find(std::ref(objective), starts, box, problem, in_box_of(problem.policy, options), candidates, report);
  SearchResult result;
  select(std::move(found), starts, objective, options.finalists, comparisons(problem, options), result);
  result.rollouts = objective.rollouts();
  result.failed_rollouts = objective.failed();
  return result;
}

SearchResult judge(const SearchProblem& problem, const Vector& theta, const SearchOptions& options,
                   const StreamKey& key) {
  SimulatedReturn objective(problem, options, key);
  Vector value(1);
  objective(theta, 0, comparisons(problem, options), value);
  return {.theta = theta,
          .predicted_return = value(0),
          .rollouts = objective.rollouts(),
          .failed_rollouts = objective.failed()};
}

Vector solving_rates(const SearchProblem& problem, const std::vector<Vector>& policies, const SearchOptions& options,
                     const StreamKey& key) {
  Vector rates = Vector::Zero(static_cast<Index>(policies.size()));
  if (!problem.task.solved) return rates;
  const Index rollouts = comparisons(problem, options);
  problem.evaluator.for_each(rates.size(), [&](Index j) {
    const Matrix Theta = policies[static_cast<std::size_t>(j)].transpose().replicate(rollouts, 1);
    rollout::Episodes episodes;
    rollout::simulate_episodes({problem.model, problem.policy, problem.task, key, options.simulate}, Theta, 0,
                               episodes);
    Episode episode;
    Index solved = 0;
    for (Index i = 0; i < episodes.rows(); ++i) {
      if (episodes.failed[static_cast<std::size_t>(i)]) continue;
      episodes.copy(i, episode);
      solved += problem.task.solved(episode);
    }
    rates(j) = static_cast<double>(solved) / static_cast<double>(rollouts);
  });
  return rates;
}

Vector random_policy(const policy::Policy& policy, const SearchOptions& options, StreamKey key) {
  key.purpose = Purpose::random_policy;
  Rng rng(key);
  Vector theta(policy.parameters());
  const auto [low, high] = interval_of(policy, options);
  for (double& value : theta) value = rng.uniform(low, high);
  return theta;
}

}  // namespace rehearse::learners::black_drops
