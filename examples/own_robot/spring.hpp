#pragma once
// Your own policy: springs and dampers. Each action is θ · x, moved into its bounds.

#include <algorithm>

#include "rehearse/core/task.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/policy.hpp"

using namespace rehearse;

/// θ: for each action one gain a state. Describable is only for exports, such as policy.h.
class Spring final : public policy::Policy, public policy::Describable {
 public:
  explicit Spring(const Task& task) : states_(task.state_size()), bounds_(task.action_bounds()) {}

  std::string name() const override { return "spring"; }
  Index parameters() const override { return actions() * states_; }
  Index actions() const override { return static_cast<Index>(bounds_.size()); }

  /// Each row has its own θ. std::clamp passes NaN on: a state that is not known gets no action.
  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double /*t_s*/, MatrixView U) const override {
    check_sizes(*this, states_, Theta, X, U);
    for (Index row = 0; row < X.rows(); ++row)
      for (Index a = 0; a < actions(); ++a) {
        double u = 0;
        for (Index s = 0; s < states_; ++s) u += Theta(row, a * states_ + s) * X(row, s);
        const auto [low, high] = bounds_[static_cast<std::size_t>(a)];
        U(row, a) = std::clamp(u, low, high);
      }
  }

  /// The same in numbers: one row of feedback around the state 0.
  policy::Description describe(const ConstVectorView& theta) const override {
    return {policy::Feedback{.actions = Matrix::Zero(1, actions()),
                             .states = Matrix::Zero(1, states_),
                             .gains = theta.transpose(),
                             .angles = std::vector<bool>(static_cast<std::size_t>(states_), false)}};
  }

 private:
  Index states_;
  std::vector<Interval> bounds_;
};
