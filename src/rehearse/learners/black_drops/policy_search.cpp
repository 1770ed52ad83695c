#include "rehearse/learners/black_drops/policy_search.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace rehearse::learners::black_drops {
namespace {

/// Imagined returns as an objective, and how many rollouts failed.
class ImaginedReturn {
 public:
  ImaginedReturn(const SearchProblem& problem, const SearchOptions& options, StreamKey key)
      : problem_(problem), options_(options), key_(key) {}

  void operator()(const ConstMatrixView& Theta, std::uint64_t first, Index samples, VectorView values) {
    const rollout::Imagined imagined =
        rollout::imagine(problem_.model, problem_.policy, problem_.task, Theta, first, samples * options_.particles,
                         key_, options_.imagine, problem_.evaluator);
    values = imagined.returns.colwise().mean().transpose();
    rollouts_ += imagined.returns.size();
    failed_ += imagined.failed;
  }

  Index rollouts() const { return rollouts_; }
  Index failed() const { return failed_; }

 private:
  const SearchProblem& problem_;
  const SearchOptions& options_;
  StreamKey key_;
  Index rollouts_ = 0, failed_ = 0;
};

class Speedometer {
 public:
  double per_s(Index count) const {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    return static_cast<double>(count) / std::max(elapsed.count(), 1e-9);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The finalists' expected returns by many rollouts; the best is the result, the others its runners-up.
void select(std::vector<optim::Contender> contenders, ImaginedReturn& objective, const SearchOptions& options,
            SearchResult& result) {
  const auto count = std::min(options.finalists, static_cast<Index>(contenders.size()));
  Matrix Theta(contenders.front().x.size(), count);
  for (Index i = 0; i < count; ++i) Theta.col(i) = contenders[static_cast<std::size_t>(i)].x;
  Vector values(count);
  objective(Theta, 0, options.selection, values);
  Index best = 0;
  result.predicted_return = values.maxCoeff(&best);
  result.theta = Theta.col(best);
  for (std::size_t i = 0; i < contenders.size(); ++i)
    if (static_cast<Index>(i) != best) result.runners_up.push_back(std::move(contenders[i].x));
}

}  // namespace

void SearchOptions::fields(FieldVisitor& v) {
  v.number("box", box, above(0));
  v.integer("particles", particles, at_least(1));
  v.group("imagine", imagine);
  v.group("race", race);
  v.integer("finalists", finalists, at_least(1));
  v.integer("selection", selection, at_least(1));
}

SearchResult search_policy(const SearchProblem& problem, const std::vector<Vector>& starts,
                           const SearchOptions& options, std::uint64_t seed, std::uint64_t trial) {
  const StreamKey key{.seed = seed, .trial = trial, .purpose = Purpose::imagined_noise};
  ImaginedReturn objective(problem, options, key);
  const Speedometer speed;
  const auto report = [&](Index evaluations, double best) {
    if (!problem.progress) return;
    problem.progress({.phase = "search",
                      .done = static_cast<double>(evaluations) / static_cast<double>(options.race.max_evaluations),
                      .best = best,
                      .rollouts = objective.rollouts(),
                      .rollouts_per_s = speed.per_s(objective.rollouts())});
  };
  const std::vector<Interval> box(static_cast<std::size_t>(problem.policy.parameters()), {-options.box, options.box});
  optim::RaceResult race =
      optim::race(std::ref(objective), starts, box, options.race,
                  {.seed = seed, .trial = trial, .purpose = Purpose::search}, problem.evaluator, report);
  SearchResult result;
  ImaginedReturn selection(problem, options, {.seed = seed, .trial = trial, .purpose = Purpose::selection});
  select(std::move(race.contenders), selection, options, result);
  result.rollouts = objective.rollouts() + selection.rollouts();
  result.failed_rollouts = objective.failed() + selection.failed();
  return result;
}

Vector random_policy(const policy::Policy& policy, const SearchOptions& options, std::uint64_t seed,
                     std::uint64_t trial) {
  Rng rng({.seed = seed, .trial = trial, .purpose = Purpose::random_policy});
  Vector theta(policy.parameters());
  for (double& value : theta) value = rng.uniform(-options.box, options.box);
  return theta;
}

}  // namespace rehearse::learners::black_drops
