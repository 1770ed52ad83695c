#include "rehearse/lqr/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "rehearse/lqr/linear_steps.hpp"
#include "rehearse/lqr/regulator.hpp"
#include "rehearse/lqr/step_costs.hpp"
#include "rehearse/rollout/forecast.hpp"

namespace rehearse::lqr {
namespace {

constexpr Index kDrawn = 100;
constexpr double kReturning = 0.95;                    // of the drawn states
constexpr double kReturned = 0.05;                     // of the level: a state that has come back
constexpr double kLost = 0.05;                         // of the reward that is lost at first: the same
constexpr double kRateTime = 0.1;                      // of an episode
constexpr double kWidest = std::numbers::pi / 2;       // of an angle, either way
constexpr double kFarthest = 100;                      // times as far as where feedback reaches a bound
constexpr double kNarrowest = 1e-9;                    // of the highest level: beyond, there is no region
constexpr double kFirstFactor = 4, kLastFactor = 1.1;  // of a level that grows
constexpr double kFirstWeights[] = {1, 1e2, 1e4};
constexpr int kBalanced = 3, kRounds = 3;
constexpr double kWeightFactor = 4;
constexpr double kWorthIt = 0.05;  // of the logarithm of the volume

/// A regulator's cost to go by the states that a policy sees, and the largest level tried that brings robots back.
struct Bowl {
  Matrix gain;   // du × dx, of actions in their own units
  Matrix shape;  // of the states seen
  Eigen::LLT<Matrix> factor;
  double level = 0;
  double log_volume = -kInf;

  double log_volume_at(double of_level) const {
    return 0.5 * static_cast<double>(shape.rows()) * std::log(of_level) -
           factor.matrixLLT().diagonal().array().log().sum();
  }
  double level_at(double of_log_volume) const {
    const double more = of_log_volume + factor.matrixLLT().diagonal().array().log().sum();
    return std::exp(2 * more / static_cast<double>(shape.rows()));
  }
};

class Widening {
 public:
  /// steps: within which a robot comes back.
  Widening(const Problem& problem, const Vector& state, const Vector& action, Index steps, const StreamKey& key)
      : problem_(problem),
        steps_(steps),
        state_(state),
        action_(action),
        half_(StepCosts(problem.task, {}).half_ranges()),
        system_(linear_system(problem, state, action)),
        feedback_(policy::make_tracking(problem.task, 2)) {
    for (Index i = 0; i < state.size(); ++i)
      if (problem.task.states[static_cast<std::size_t>(i)].kind != StateKind::omitted) seen_.push_back(i);
    Rng rng(key);
    directions_.resize(static_cast<Index>(seen_.size()), kDrawn);
    for (double& number : directions_.reshaped()) number = rng.normal();
    directions_.colwise().normalize();
  }

  std::optional<Region> run() {
    Vector weights;
    std::optional<Bowl> best;
    for (const double weight : kFirstWeights) {
      const Vector first_weights = weight * first_units().cwiseAbs2();
      auto first = begun(first_weights);
      if (first && (!best || first->log_volume > best->log_volume)) best = std::move(first), weights = first_weights;
    }
    if (!best) return std::nullopt;
    for (int i = 0; i < kBalanced; ++i) {  // each state counts as its region is narrow
      const Matrix inverse = best->factor.solve(Matrix::Identity(weights.size(), weights.size()));
      const Vector balanced = (best->level * inverse.diagonal()).cwiseInverse();
      if (!widen(balanced, weights, *best)) break;
    }
    bool wider = true;
    for (int round = 0; round < kRounds && wider; ++round) {
      wider = false;
      for (Index i = 0; i < weights.size(); ++i)
        for (const double factor : {kWeightFactor, 1 / kWeightFactor}) {
          Vector other = weights;
          other(i) *= factor;
          if (!widen(other, weights, *best)) continue;
          wider = true;
          break;
        }
    }
    const Index dx = state_.size();
    Region region{{{action_, state_, best->gain}, Matrix::Zero(dx, dx)}, best->log_volume};
    region.hand_over.shape(seen_, seen_) = best->shape / best->level;
    return region;
  }

 private:
  std::optional<Bowl> bowl(const Vector& weights) const {
    Vector all = Vector::Zero(state_.size());
    all(seen_) = weights;
    const auto regulator = regulate(system_, all);
    if (!regulator) return std::nullopt;
    Bowl bowl{.gain = half_.asDiagonal() * regulator->gain, .shape = regulator->S(seen_, seen_), .factor = {}};
    for (Index i = 0; i < state_.size(); ++i)
      if (std::ranges::find(seen_, i) == seen_.end()) {
        if (!bowl.gain.col(i).isZero(1e-9 * bowl.gain.norm())) return std::nullopt;
        bowl.gain.col(i).setZero();
      }
    bowl.factor.compute(bowl.shape);
    if (bowl.factor.info() != Eigen::Success) return std::nullopt;
    return bowl;
  }

  /// The level at which a region is as wide as it may be.
  double highest(const Bowl& bowl) const {
    const auto level_at = [&](const Vector& row, double most) {  // where row · (x − x*) reaches it
      return most * most / row.dot(bowl.factor.solve(row));
    };
    double level = kInf;
    for (Index a = 0; a < half_.size(); ++a)
      level = std::min(level, level_at(bowl.gain(a, seen_).transpose(), kFarthest * half_(a)));
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (problem_.task.states[static_cast<std::size_t>(seen_[i])].kind == StateKind::angle)
        level = std::min(level, level_at(Vector::Unit(bowl.shape.rows(), static_cast<Index>(i)), kWidest));
    return level;
  }

  /// The reward that staying in states (rows × dx) has less than staying at the goal.
  Vector lost(const Matrix& states) const {
    const StepCosts costs(problem_.task, {.action_cost = 0});
    const double end_s = problem_.task.episode_s();
    const Matrix actions = action_.transpose().replicate(states.rows(), 1);
    return costs.of_staying(states, actions, end_s).array() -
           costs.of_staying(state_.transpose(), action_.transpose(), end_s)(0);
  }

  bool returns(const Bowl& bowl, double level) const {
    const Matrix apart = std::sqrt(level) * bowl.factor.matrixU().solve(directions_);
    Matrix from = state_.transpose().replicate(kDrawn, 1);
    for (std::size_t k = 0; k < seen_.size(); ++k) from.col(seen_[k]) += apart.row(static_cast<Index>(k)).transpose();
    const policy::FeedbackStage stage{action_, state_, bowl.gain};
    const Vector theta = policy::to_theta({stage, stage});
    const Matrix to =
        rollout::follow(problem_.model, problem_.task, {*feedback_, theta}, from, steps_, problem_.evaluator);
    const Vector lost_at_first = lost(from), lost_at_last = lost(to);
    const double most_lost = kLost * lost_at_first.mean();
    Index back = 0;
    for (Index i = 0; i < to.rows(); ++i) {
      const Vector left = problem_.task.difference(to.row(i).transpose(), state_)(seen_);
      back += left.dot(bowl.shape * left) < kReturned * level && lost_at_last(i) <= most_lost;
    }
    return static_cast<double>(back) >= kReturning * kDrawn;
  }

  /// The states' units that the first weights are for: 1, and of a rate what changes its state by 1 in some steps.
  Vector first_units() const {
    Vector units = Vector::Ones(state_.size());
    for (const Kinematics::Pair& pair : problem_.task.kinematics().pairs)
      units(pair.rate) = kRateTime * problem_.task.episode_s();
    return units(seen_);
  }

  /// The first region, however small.
  std::optional<Bowl> begun(const Vector& weights) const {
    auto first = bowl(weights);
    if (!first) return std::nullopt;
    const double most = highest(*first);
    if (!std::isfinite(most)) return std::nullopt;
    for (double level = most; level > kNarrowest * most; level /= kFirstFactor)
      if (returns(*first, level)) {
        first->level = level;
        first->log_volume = first->log_volume_at(level);
        return first;
      }
    return std::nullopt;
  }

  /// Replaces the best by the region of other weights if that is larger.
  bool widen(const Vector& other, Vector& weights, Bowl& best) const {
    auto found = bowl(other);
    if (!found) return false;
    const double most = highest(*found);
    double level = found->level_at(best.log_volume + kWorthIt);
    if (!(level <= most) || !returns(*found, level)) return false;
    for (double factor = kFirstFactor; factor > kLastFactor;) {
      const double more = std::min(level * factor, most);
      if (more > level && returns(*found, more))
        level = more;
      else
        factor = std::sqrt(factor);
    }
    found->level = level;
    found->log_volume = found->log_volume_at(level);
    weights = other;
    best = std::move(*found);
    return true;
  }

  const Problem& problem_;
  const Index steps_;
  const Vector &state_, &action_;
  Vector half_;
  LinearSystem system_;
  std::shared_ptr<const policy::Policy> feedback_;
  std::vector<Index> seen_;
  Matrix directions_;  // states seen × drawn, of length 1
};

}  // namespace

std::optional<Region> widest_region(const Problem& problem, const Vector& state, const Vector& action,
                                    const StreamKey& key) {
  const Index half = (problem.task.horizon + 1) / 2;
  auto region = Widening(problem, state, action, half, key).run();
  return region ? region : Widening(problem, state, action, problem.task.horizon, key).run();
}

}  // namespace rehearse::lqr
