#include "rehearse/policy/hand_over.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/state_difference.hpp"

namespace rehearse::policy {
namespace {

/// The numbers behind those of the policy elsewhere.
Vector numbers_of(const HandOver& near) {
  const Vector stage = to_theta(std::vector<FeedbackStage>{near.feedback});
  Vector numbers(stage.size() + near.shape.size());
  numbers << stage, near.shape.transpose().reshaped();
  return numbers;
}

class HandingOver final : public Policy, public Describable {
 public:
  /// fixed: null: the numbers of the feedback are the last ones of θ.
  HandingOver(const Task& task, std::shared_ptr<const Policy> elsewhere, const HandOver* fixed)
      : elsewhere_(std::move(elsewhere)), bounds_(task.action_bounds()), of_stage_(numbers_of_stage(task)) {
    for (const StateVariable& state : task.states) angle_.push_back(state.kind == StateKind::angle);
    if (!fixed) return;
    fixed_ = numbers_of(*fixed);
    if (fixed_.size() != numbers())
      throw InvalidInput(fmt::format("the feedback has {} numbers, must have {}", fixed_.size(), numbers()));
  }

  std::string name() const override { return kHandOver; }
  Index parameters() const override { return elsewhere_->parameters() + (fixed_.size() > 0 ? 0 : numbers()); }
  Index actions() const override { return static_cast<Index>(bounds_.size()); }
  std::optional<Interval> box() const override { return elsewhere_->box(); }
  Matrix examples() const override { return fixed_.size() > 0 ? elsewhere_->examples() : Matrix(0, parameters()); }

  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const override {
    check_sizes(*this, states(), Theta, X, U);
    const Index own = elsewhere_->parameters();
    elsewhere_->act(Theta.leftCols(own), X, t_s, U);
    if (fixed_.size() > 0)
      take_over([&](Index k) { return fixed_(k); }, X, U);
    else
      take_over([&](Index k) { return Theta.col(own + k).array(); }, X, U);
  }

  Description describe(const ConstVectorView& theta) const override {
    const Index own = elsewhere_->parameters(), dx = states(), du = actions();
    Description all = policy::describe(*elsewhere_, theta.head(own));
    const Vector numbers = fixed_.size() > 0 ? fixed_ : Vector(theta.tail(theta.size() - own));
    all.near = Near{.action = numbers.head(du),
                    .state = numbers.segment(du, dx),
                    .gain = numbers.segment(du + dx, du * dx).reshaped(dx, du).transpose(),
                    .shape = numbers.tail(dx * dx).reshaped(dx, dx).transpose(),
                    .angles = angle_};
    return all;
  }

 private:
  Index states() const { return static_cast<Index>(angle_.size()); }
  Index numbers() const { return of_stage_ + states() * states(); }

  /// Replaces the actions of the rows that are near. number(k): the k-th of the feedback, or one a row.
  template <class Number>
  void take_over(const Number& number, const ConstMatrixView& X, MatrixView U) const {
    thread_local Eigen::ArrayXXd difference, u;
    thread_local Eigen::ArrayXd inside, along;
    const Index n = X.rows(), dx = states(), du = actions(), shape = of_stage_;
    difference.resize(n, dx);
    for (Index i = 0; i < dx; ++i)
      difference_from(number(du + i), angle_[static_cast<std::size_t>(i)], X.col(i), difference.col(i));
    inside.setZero(n);
    for (Index i = 0; i < dx; ++i) {
      along.setZero(n);
      for (Index j = 0; j < dx; ++j) along += number(shape + i * dx + j) * difference.col(j);
      inside += difference.col(i) * along;
    }
    if (!(inside < 1).any()) return;
    u.resize(n, du);
    for (Index a = 0; a < du; ++a) {
      u.col(a).setZero();
      u.col(a) += number(a);
      for (Index i = 0; i < dx; ++i) u.col(a) += number(du + dx + a * dx + i) * difference.col(i);
    }
    for (Index row = 0; row < n; ++row) {
      if (!(inside(row) < 1)) continue;
      for (Index a = 0; a < du; ++a) {
        const auto [low, high] = bounds_[static_cast<std::size_t>(a)];
        U(row, a) = std::clamp(u(row, a), low, high);
      }
    }
  }

  std::shared_ptr<const Policy> elsewhere_;
  std::vector<Interval> bounds_;
  std::vector<bool> angle_;
  Index of_stage_;  // numbers of the feedback without the shape
  Vector fixed_;    // empty: in θ
};

}  // namespace

std::shared_ptr<const Policy> make_hand_over(const Task& task, std::shared_ptr<const Policy> elsewhere) {
  return std::make_shared<HandingOver>(task, std::move(elsewhere), nullptr);
}

std::shared_ptr<const Policy> with_hand_over(const Task& task, std::shared_ptr<const Policy> elsewhere,
                                             const HandOver& near) {
  return std::make_shared<HandingOver>(task, std::move(elsewhere), &near);
}

Vector to_theta(const ConstVectorView& elsewhere, const HandOver& near) {
  const Vector numbers = numbers_of(near);
  Vector theta(elsewhere.size() + numbers.size());
  theta << elsewhere, numbers;
  return theta;
}

}  // namespace rehearse::policy
