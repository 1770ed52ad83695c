#include "rehearse/policy/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/policy/description.hpp"

namespace rehearse::policy {
namespace {

class Schedule final : public Policy, public Describable {
 public:
  Schedule(std::vector<Interval> bounds, double dt_s, Index steps)
      : bounds_(std::move(bounds)), dt_s_(dt_s), steps_(steps) {}

  std::string name() const override { return kSchedule; }
  Index parameters() const override { return steps_ * actions(); }
  Index actions() const override { return static_cast<Index>(bounds_.size()); }

  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const override {
    check_sizes(*this, -1, Theta, X, U);
    const Index step = std::clamp<Index>(std::lround(t_s / dt_s_), 0, steps_ - 1);
    for (Index row = 0; row < X.rows(); ++row) {
      const bool lost = X.row(row).array().isNaN().any();
      for (Index a = 0; a < actions(); ++a) {
        const auto [low, high] = bounds_[static_cast<std::size_t>(a)];
        U(row, a) = lost ? kNaN : std::clamp(Theta(row, a * steps_ + step), low, high);
      }
    }
  }

  Description describe(const ConstVectorView& theta) const override {
    Table table{.actions = theta.reshaped(steps_, actions()), .per_s = 1 / dt_s_};
    for (Index a = 0; a < actions(); ++a) {
      const auto [low, high] = bounds_[static_cast<std::size_t>(a)];
      table.actions.col(a) = table.actions.col(a).cwiseMax(low).cwiseMin(high).eval();
    }
    return {std::move(table)};
  }

 private:
  std::vector<Interval> bounds_;
  double dt_s_;
  Index steps_;
};

}  // namespace

std::shared_ptr<const Policy> make_schedule(std::vector<Interval> bounds, double dt_s, Index steps) {
  Violations violations;
  violations.require(dt_s > 0, fmt::format("schedule dt_s = {}, must be > 0", dt_s));
  violations.require(steps >= 1, fmt::format("schedule steps = {}, must be ≥ 1", steps));
  violations.require(!bounds.empty(), "policy has no actions");
  violations.throw_if_any();
  return std::make_shared<Schedule>(std::move(bounds), dt_s, steps);
}

Vector random_schedule(const Task& task, RandomActions actions, double hold_s, StreamKey key) {
  const double longest = std::max(1.0, static_cast<double>(task.horizon / 5));  // one constant action shows little
  const auto hold = static_cast<Index>(std::lround(std::clamp(hold_s / task.dt_s, 1.0, longest)));
  key.purpose = Purpose::random_policy;
  Rng rng(key);
  Vector theta(task.horizon * task.action_size());
  for (Index i = 0; i < theta.size(); ++i) {
    const Interval& bounds = task.actions[static_cast<std::size_t>(i / task.horizon)].bounds;
    const auto draw = [&] {
      const double action = rng.uniform(bounds.low, bounds.high);
      if (actions == RandomActions::uniform) return action;
      return action < 0.5 * (bounds.low + bounds.high) ? bounds.low : bounds.high;
    };
    theta(i) = i % task.horizon % hold == 0 ? draw() : theta(i - 1);
  }
  return theta;
}

}  // namespace rehearse::policy
