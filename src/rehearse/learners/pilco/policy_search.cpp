#include "rehearse/learners/pilco/policy_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "rehearse/core/stopwatch.hpp"
#include "rehearse/learners/pilco/initial_policy.hpp"
#include "rehearse/moments/expected_return.hpp"

namespace rehearse::learners::pilco {
namespace {

/// The expected return as an objective of θ / units.
class Objective {
 public:
  Objective(const SearchProblem& problem, const SearchOptions& options, Index searches)
      : problem_(problem),
        expected_(problem.task, problem.policy, problem.dynamics, start_state(problem.task, options)),
        units_(units_of(problem.policy)),
        usual_evaluations_(2 * static_cast<double>(options.bfgs.line_searches * searches)) {}

  double operator()(const Vector& x, Vector& gradient) {
    const Vector theta = x.cwiseProduct(units_);
    const moments::Return found = expected_(theta, &gradient, workspace_, problem_.evaluator);
    gradient.array() *= units_.array();
    ++evaluations_;
    failed_ += !found.ok();
    if (found.ok()) best_ = evaluations_ - failed_ == 1 ? found.value : std::max(best_, found.value);
    report();
    return found.value;
  }

  /// NaN where it has no value.
  double at(const Vector& theta) {
    Vector gradient;
    return (*this)(theta.cwiseQuotient(units_), gradient);
  }

  const Vector& units() const { return units_; }
  Index evaluations() const { return evaluations_; }
  Index failed() const { return failed_; }

 private:
  void report() const {
    if (!problem_.progress) return;
    problem_.progress({.phase = "search",
                       .done = std::min(1.0, static_cast<double>(evaluations_) / usual_evaluations_),
                       .best = best_,
                       .rollouts = evaluations_,
                       .rollouts_per_s = watch_.per_s(evaluations_)});
  }

  const SearchProblem& problem_;
  moments::ExpectedReturn expected_;
  moments::ReturnWorkspace workspace_;
  Vector units_;
  double usual_evaluations_, best_ = 0;
  Index evaluations_ = 0, failed_ = 0;
  Stopwatch watch_;
};

SearchResult search(Objective& objective, const Vector& start, const SearchOptions& options) {
  const optim::GradientResult found =
      optim::maximise_cautious_bfgs(std::ref(objective), start.cwiseQuotient(objective.units()), options.bfgs);
  SearchResult result{.theta = start, .evaluations = objective.evaluations(), .failed = objective.failed()};
  if (!std::isfinite(found.value)) return result;
  result.theta = found.x.cwiseProduct(objective.units());
  result.predicted_return = found.value;
  return result;
}

std::vector<Vector> first_policies(const SearchProblem& problem, const SearchOptions& options, StreamKey key) {
  std::vector<Vector> first;
  const moments::Gaussian begin = start_state(problem.task, options);
  for (Index k = 1; k <= options.restarts; ++k) {
    key.candidate = static_cast<std::uint64_t>(k);
    first.push_back(initial_policy(problem.policy, begin, key));
  }
  return first;
}

/// The `count` policies of the highest value, best first.
std::vector<Vector> best_policies(Objective& objective, const std::vector<Vector>& policies, Index count) {
  std::vector<std::pair<double, const Vector*>> by_value;
  for (const Vector& theta : policies) {
    const double value = objective.at(theta);
    by_value.emplace_back(std::isfinite(value) ? value : -kInf, &theta);
  }
  std::ranges::stable_sort(by_value, std::greater(), &std::pair<double, const Vector*>::first);
  std::vector<Vector> best;
  for (const auto& [value, theta] : by_value)
    if (static_cast<Index>(best.size()) < count) best.push_back(*theta);
  return best;
}

}  // namespace

void SearchOptions::fields(FieldVisitor& v) {
  v.publish("patience", published(0, "PILCO"));
  bfgs.fields(v);
  v.number("start_std", start_std,
           "smallest standard deviation of the start state in policy searches [each state's unit]", between(0, 1e6),
           published(0.1, "PILCO"));
  v.integer("restarts", restarts, "further random initial policies per search, until a trial solves the task",
            between(0, 1000), published(0, "PILCO"));
}

moments::Gaussian start_state(const Task& task, const SearchOptions& options) {
  return {task.start_mean, Matrix(task.start_std.cwiseMax(options.start_std).cwiseAbs2().asDiagonal())};
}

SearchResult search_policy(const SearchProblem& problem, const Vector& start, const SearchOptions& options) {
  Objective objective(problem, options, 1);
  return search(objective, start, options);
}

SearchResult search_with_restarts(const SearchProblem& problem, const Vector& start, const SearchOptions& options,
                                  const Restarts& restarts, std::optional<double> earned) {
  Objective objective(problem, options, 1 + options.restarts);
  SearchResult best = search(objective, start, options);
  if (earned && best.predicted_return)  // fmax: where the start has no value nothing is known of the model
    *best.predicted_return -= std::fmax(0, objective.at(start) - *earned);
  std::vector<Vector> others;
  if (options.restarts > 0)
    others = restarts.policies.empty() ? first_policies(problem, options, restarts.key)
                                       : best_policies(objective, restarts.policies, options.restarts);
  for (const Vector& other : others) {
    SearchResult fresh = search(objective, other, options);
    if (fresh.predicted_return > best.predicted_return) best = std::move(fresh);  // none is less than any
  }
  best.evaluations = objective.evaluations();
  best.failed = objective.failed();
  return best;
}

}  // namespace rehearse::learners::pilco
