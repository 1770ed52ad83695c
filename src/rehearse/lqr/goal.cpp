#include "rehearse/lqr/goal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "rehearse/lqr/hold.hpp"
#include "rehearse/lqr/linear_steps.hpp"
#include "rehearse/lqr/region.hpp"

namespace rehearse::lqr {
namespace {

constexpr Index kStates = 256;                            // that are drawn
constexpr std::size_t kBegun = 6;                         // of these from which staying is looked for
constexpr double kApart = 0.5;                            // between two of them, in one angle at least [rad]
constexpr double kNearestTurn = -1, kFarthestTurn = 0.5;  // from the start: powers of ten, in rad
constexpr double kActionCost = 1e-3;                      // of an action at its bound, beside the reward

class Search {
 public:
  Search(const Problem& problem, const StreamKey& key)
      : problem_(problem), key_(key), end_s_(problem.task.episode_s()) {
    draw();
    draw_turns();
    const Vector rewards = -costs(CostScale::linear, 0).of_staying(states_, actions_, end_s_);
    scale_ = rewards.minCoeff() > 0 ? CostScale::logarithmic : CostScale::linear;
  }

  std::optional<policy::HandOver> run() const {
    const auto goal = cheapest();
    if (!goal) return std::nullopt;
    auto widest = widest_region(problem_, goal->stage.state, goal->stage.action, key_);
    if (!widest) return std::nullopt;
    return std::move(widest->hand_over);
  }

 private:
  StepCosts costs(CostScale scale, double action_cost) const {
    return {problem_.task, {.scale = scale, .action_cost = action_cost}};
  }

  void draw() {
    const Task& task = problem_.task;
    StreamKey key = key_;
    key.candidate = 1;  // a region's have the key as it is
    Rng rng(key);
    states_ = task.start_mean.transpose().replicate(kStates, 1);
    for (Index i = 1; i < kStates; ++i)  // the first is the start
      for (Index s = 0; s < task.state_size(); ++s)
        if (task.states[static_cast<std::size_t>(s)].kind == StateKind::angle)
          states_(i, s) = rng.uniform(-std::numbers::pi, std::numbers::pi);
    actions_.resize(kStates, task.action_size());
    for (Index a = 0; a < task.action_size(); ++a) {
      const Interval bounds = task.actions[static_cast<std::size_t>(a)].bounds;
      actions_.col(a).setConstant(0.5 * (bounds.low + bounds.high));
    }
  }

  /// Joints in rad whose turns count. Their ranges are not known, so they are drawn at all distances from the start.
  void draw_turns() {
    const Task& task = problem_.task;
    StreamKey key = key_;
    key.candidate = 2;
    Rng rng(key);
    for (Index s = 0; s < task.state_size(); ++s) {
      const StateVariable& state = task.states[static_cast<std::size_t>(s)];
      if (state.kind == StateKind::angle || state.rate.empty() || state.unit != "rad") continue;
      for (Index i = 1; i < kStates; ++i)
        states_(i, s) += std::pow(10, rng.uniform(kNearestTurn, kFarthestTurn)) * rng.uniform(-1, 1);
    }
  }

  /// The cheapest of the states that the robot can stay in, looked for from some of the cheapest that were drawn.
  std::optional<Hold> cheapest() const {
    const StepCosts costs = this->costs(scale_, kActionCost);
    const std::vector<Index> rows = begun(costs.of_staying(states_, actions_, end_s_));
    return find_cheapest_hold(problem_, costs, states_(rows, Eigen::all), actions_(rows, Eigen::all), end_s_);
  }

  /// The cheapest states that differ; the start is one of them.
  std::vector<Index> begun(const Vector& of_staying) const {
    std::vector<Index> order(static_cast<std::size_t>(kStates)), chosen = {0};
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::stable_sort(order, [&](Index a, Index b) { return of_staying(a) < of_staying(b); });
    const auto differs = [&](Index a, Index b) {
      return problem_.task.difference(states_.row(a).transpose(), states_.row(b).transpose()).cwiseAbs().maxCoeff() >
             kApart;
    };
    for (const Index i : order)
      if (chosen.size() < kBegun && std::ranges::all_of(chosen, [&](Index other) { return differs(i, other); }))
        chosen.push_back(i);
    return chosen;
  }

  const Problem& problem_;
  StreamKey key_;
  double end_s_;
  Matrix states_, actions_;
  CostScale scale_ = CostScale::linear;
};

}  // namespace

std::optional<policy::HandOver> find_goal(const Problem& problem, const StreamKey& key) {
  return Search(problem, key).run();
}

}  // namespace rehearse::lqr
