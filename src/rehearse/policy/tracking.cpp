#include "rehearse/policy/tracking.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/state_difference.hpp"

namespace rehearse::policy {
namespace {

constexpr double kSameStep = 1e-9;  // of a step: times of steps are not exact

class Tracking final : public Policy, public Describable {
 public:
  Tracking(const Task& task, Index stages) : bounds_(task.action_bounds()), dt_s_(task.dt_s), stages_(stages) {
    for (const StateVariable& state : task.states) angle_.push_back(state.kind == StateKind::angle);
  }

  std::string name() const override { return kTracking; }
  Index parameters() const override { return stages_ * numbers(); }
  Index actions() const override { return static_cast<Index>(bounds_.size()); }

  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const override {
    check_sizes(*this, states(), Theta, X, U);
    const double place = std::isnan(t_s) ? 0 : std::clamp(t_s / dt_s_, 0.0, static_cast<double>(stages_ - 1));
    const auto stage = static_cast<Index>(place + kSameStep);
    const double beyond = place - static_cast<double>(stage);
    act_in(stage, Theta, X, U);
    if (beyond > kSameStep) {
      thread_local Matrix next;
      next.resize(U.rows(), U.cols());
      act_in(stage + 1, Theta, X, next);
      U += beyond * (next - U);
    }
    for (Index row = 0; row < X.rows(); ++row) {
      const bool lost = X.row(row).array().isNaN().any();
      for (Index a = 0; a < actions(); ++a) {
        const auto [low, high] = bounds_[static_cast<std::size_t>(a)];
        U(row, a) = lost ? kNaN : std::clamp(U(row, a), low, high);
      }
    }
  }

  Description describe(const ConstVectorView& theta) const override {
    const Index dx = states(), du = actions();
    const Matrix by_stage = theta.reshaped(numbers(), stages_).transpose();
    return {Feedback{.actions = by_stage.leftCols(du),
                     .states = by_stage.middleCols(du, dx),
                     .gains = by_stage.rightCols(du * dx),
                     .per_s = 1 / dt_s_,
                     .angles = angle_}};
  }

 private:
  /// Writes the actions of a stage before they are moved into their bounds.
  void act_in(Index stage, const ConstMatrixView& Theta, const ConstMatrixView& X, MatrixView U) const {
    thread_local Eigen::ArrayXd difference;
    difference.resize(X.rows());
    const auto of_stage = [&](Index number) { return Theta.col(stage * numbers() + number).array(); };
    const Index dx = states(), du = actions();
    for (Index a = 0; a < du; ++a) U.col(a) = of_stage(a).matrix();
    for (Index i = 0; i < dx; ++i) {
      difference_from(of_stage(du + i), angle_[static_cast<std::size_t>(i)], X.col(i), difference);
      for (Index a = 0; a < du; ++a) U.col(a).array() += of_stage(du + dx + a * dx + i) * difference;
    }
  }

  Index states() const { return static_cast<Index>(angle_.size()); }
  Index numbers() const { return actions() + states() + actions() * states(); }

  std::vector<Interval> bounds_;
  std::vector<bool> angle_;
  double dt_s_;
  Index stages_;
};

}  // namespace

std::shared_ptr<const Policy> make_tracking(const Task& task, Index stages) {
  if (stages < 2) throw InvalidInput(fmt::format("a tracking policy has {} stages, must have ≥ 2", stages));
  return std::make_shared<Tracking>(task, stages);
}

Index numbers_of_stage(const Task& task) {
  const Index dx = task.state_size(), du = task.action_size();
  return du + dx + du * dx;
}

std::vector<FeedbackStage> open_loop(const Task& task, const ConstMatrixView& actions) {
  const Matrix no_gain = Matrix::Zero(task.action_size(), task.state_size());
  std::vector<FeedbackStage> stages;
  for (Index t = 0; t < actions.rows(); ++t) stages.push_back({actions.row(t).transpose(), task.start_mean, no_gain});
  stages.push_back(stages.back());
  return stages;
}

Vector to_theta(const std::vector<FeedbackStage>& stages) {
  const Index du = stages.front().action.size(), dx = stages.front().state.size(), numbers = du + dx + du * dx;
  Vector theta(numbers * static_cast<Index>(stages.size()));
  for (std::size_t s = 0; s < stages.size(); ++s) {
    auto part = theta.segment(static_cast<Index>(s) * numbers, numbers);
    part.head(du) = stages[s].action;
    part.segment(du, dx) = stages[s].state;
    for (Index a = 0; a < du; ++a) part.segment(du + dx + a * dx, dx) = stages[s].gain.row(a).transpose();
  }
  return theta;
}

std::vector<FeedbackStage> to_stages(const Task& task, const ConstVectorView& theta) {
  const Index dx = task.state_size(), du = task.action_size(), numbers = numbers_of_stage(task);
  std::vector<FeedbackStage> stages(static_cast<std::size_t>(theta.size() / numbers));
  for (std::size_t s = 0; s < stages.size(); ++s) {
    const auto part = theta.segment(static_cast<Index>(s) * numbers, numbers);
    stages[s] = {part.head(du), part.segment(du, dx), part.tail(du * dx).reshaped(dx, du).transpose()};
  }
  return stages;
}

}  // namespace rehearse::policy
