#include "rehearse/learners/gp_ilqg/plan.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/learners/gp_ilqg/forward_pass.hpp"
#include "rehearse/lqr/linear_steps.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-8, kMostDamping = 1e8, kDampingFactor = 5;
constexpr int kStepLengths = 10;      // 1, 1/2, 1/4, …
constexpr double kNegligible = 1e-5;  // of the cost: a gain that is none
constexpr int kPatience = 3;          // such gains one after the other end the search

class Improvement {
 public:
  Improvement(const lqr::Problem& problem, const PlanOptions& options, std::vector<policy::FeedbackStage> stages,
              const lqr::Hold* hold)
      : problem_(problem),
        options_(options),
        hold_(hold),
        costs_(problem.task, options.cost),
        forward_(problem, costs_, hold),
        stages_(std::move(stages)) {
    if (hold_) stages_.back() = hold_->stage;
  }

  Plan run() {
    accept(forward_.follow({stages_}).front());
    int negligible = 0;
    for (Index i = 0; i < options_.iterations && negligible < kPatience && std::isfinite(now_.cost); ++i) {
      problem_.evaluator.stop_if_asked();
      linearise();
      const double before = now_.cost;
      if (!improve()) break;
      negligible = before - now_.cost < kNegligible * (std::abs(before) + kNegligible) ? negligible + 1 : 0;
    }
    if (std::isfinite(now_.cost)) give_gains();
    return {stages_, now_.states, now_.cost, now_.promise, now_.steps};
  }

 private:
  std::size_t steps() const { return static_cast<std::size_t>(now_.steps); }

  /// The stages follow this trajectory.
  void accept(Trajectory trajectory) {
    now_ = std::move(trajectory);
    for (std::size_t t = 0; t < steps(); ++t) {
      stages_[t].action = now_.actions.row(static_cast<Index>(t)).transpose();
      stages_[t].state = now_.states.row(static_cast<Index>(t)).transpose();
    }
  }

  void linearise() { planned_ = lqr::planned_steps(problem_, costs_, now_, at_); }

  lqr::Value end() const {
    const Index n = costs_.columns().planner_state();
    if (!hold_ || now_.steps + 1 < static_cast<Index>(stages_.size())) return {Vector::Zero(n), Matrix::Zero(n, n)};
    return {hold_->value.S * forward_.beside_hold(now_), hold_->value.S};
  }

  /// The best of all step lengths, with more damping until one is better than the plan. False: none is.
  bool improve() {
    for (; damping_ <= kMostDamping; damping_ *= kDampingFactor) {
      const auto pass = lqr::backward_pass(planned_, end(), damping_, options_.uncertainty);
      if (!pass) continue;
      std::vector<std::vector<policy::FeedbackStage>> candidates;
      double length = 1;
      for (int i = 0; i < kStepLengths; ++i, length *= 0.5) candidates.push_back(with(*pass, length));
      std::vector<Trajectory> tried = forward_.follow(candidates);
      const double unsure = cost_of_uncertainty(now_, at_.variance, *pass);
      std::size_t best = tried.size();
      double lowest = now_.cost + unsure;
      for (std::size_t i = 0; i < tried.size(); ++i) {
        if (!std::isfinite(tried[i].cost)) continue;
        const double cost = tried[i].cost + cost_of_uncertainty(tried[i], *pass);
        if (cost < lowest) lowest = cost, best = i;
      }
      if (best == tried.size()) continue;
      for (std::size_t t = 0; t < pass->feedback.size(); ++t) stages_[t].gain = candidates[best][t].gain;
      accept(std::move(tried[best]));
      damping_ = std::max(damping_ / kDampingFactor, kLeastDamping);
      return true;
    }
    return false;
  }

  std::vector<policy::FeedbackStage> with(const lqr::BackwardPass& pass, double length) const {
    std::vector<policy::FeedbackStage> stages = stages_;
    const Vector& half = costs_.half_ranges();
    for (std::size_t t = 0; t < pass.feedback.size(); ++t) {
      stages[t].action += length * half.cwiseProduct(pass.feedback[t].open);
      stages[t].gain = gain_of(pass.feedback[t]);
    }
    return stages;
  }

  /// The gain by the robot's state alone; 0 by what a policy does not see of it.
  Matrix gain_of(const lqr::Feedback& feedback) const {
    Matrix gain = costs_.half_ranges().asDiagonal() * feedback.gain.leftCols(costs_.columns().dx);
    for (Index i = 0; i < gain.cols(); ++i)
      if (problem_.task.states[static_cast<std::size_t>(i)].kind == StateKind::omitted) gain.col(i).setZero();
    return gain;
  }

  /// The cost of the model's variance along a trajectory, with the costs to go of one pass.
  double cost_of_uncertainty(const Trajectory& trajectory, const Matrix& variance,
                             const lqr::BackwardPass& pass) const {
    double sum = 0;
    const Index steps = std::min(trajectory.steps, static_cast<Index>(pass.feedback.size()));
    for (Index t = 0; t < steps; ++t)
      for (Index i = 0; i < variance.cols(); ++i)
        sum += 0.5 * variance(t, i) *
               lqr::curvature_at_next(planned_[static_cast<std::size_t>(t)],
                                      pass.values[static_cast<std::size_t>(t) + 1], i);
    return options_.uncertainty * sum;
  }

  double cost_of_uncertainty(const Trajectory& trajectory, const lqr::BackwardPass& pass) const {
    if (problem_.model.certain() || options_.uncertainty == 0) return 0;
    Matrix mean(trajectory.steps, problem_.task.state_size()), variance = mean;
    problem_.model.predict(trajectory.states.topRows(trajectory.steps), trajectory.actions, mean, variance);
    return cost_of_uncertainty(trajectory, variance, pass);
  }

  /// Gains about where the plan ended up, not about the one before.
  void give_gains() {
    linearise();
    std::optional<lqr::BackwardPass> pass;
    for (double damping = kLeastDamping; !pass && damping <= kMostDamping; damping *= kDampingFactor)
      pass = lqr::backward_pass(planned_, end(), damping, options_.uncertainty);
    if (!pass) return;
    for (std::size_t t = 0; t < steps(); ++t) stages_[t].gain = gain_of(pass->feedback[t]);
    if (!hold_) stages_.back() = stages_[stages_.size() - 2];
  }

  const lqr::Problem& problem_;
  const PlanOptions& options_;
  const lqr::Hold* hold_;
  lqr::StepCosts costs_;
  ForwardPass forward_;
  std::vector<policy::FeedbackStage> stages_;
  Trajectory now_;
  dynamics::Linearised at_;
  std::vector<lqr::PlannedStep> planned_;
  double damping_ = kFirstDamping;
};

}  // namespace

Plan improve(const lqr::Problem& problem, const PlanOptions& options, std::vector<policy::FeedbackStage> stages,
             const lqr::Hold* hold) {
  return Improvement(problem, options, std::move(stages), hold).run();
}

}  // namespace rehearse::learners::gp_ilqg
