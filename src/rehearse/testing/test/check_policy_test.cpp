#include "rehearse/testing/check_policy.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "rehearse/robots/pendubot/pendubot.hpp"
#include "small_task.hpp"

namespace rehearse::testing {
namespace {

/// One parameter, one action: u = law(θ, x) row by row, of the whole batch.
class Made final : public policy::Policy {
 public:
  using Act = std::function<void(const ConstMatrixView& Theta, const ConstMatrixView& X, MatrixView U)>;
  explicit Made(Act act, Index parameters = 1, Index actions = 1)
      : act_(std::move(act)), parameters_(parameters), actions_(actions) {}
  std::string name() const override { return "made"; }
  Index parameters() const override { return parameters_; }
  Index actions() const override { return actions_; }
  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double, MatrixView U) const override {
    act_(Theta, X, U);
  }

 private:
  Act act_;
  Index parameters_, actions_;
};

void good(const ConstMatrixView& Theta, const ConstMatrixView& X, MatrixView U) {
  for (Index i = 0; i < X.rows(); ++i) U(i, 0) = std::tanh(Theta(i, 0) * X(i, 0));
}

std::string check(Made::Act act) { return joined(check_policy(Made(std::move(act)), small_task())); }

TEST(CheckPolicy, AcceptsGoodOnes) {
  EXPECT_EQ(check(good), "");
  const auto scenario = robots::pendubot::make({});
  EXPECT_EQ(check_policy(*scenario.policy, scenario.task), std::vector<std::string>{});
}

TEST(CheckPolicy, FindsFaults) {
  const auto unbounded = [](const ConstMatrixView& Theta, const ConstMatrixView& X, MatrixView U) {
    U = Theta.cwiseProduct(X);
  };
  EXPECT_NE(check(unbounded).find("outside its bounds -1 to 1"), std::string::npos);
  const auto mixing = [](const ConstMatrixView& Theta, const ConstMatrixView& X, MatrixView U) {
    good(Theta, X, U);
    U *= 1 / (1 + U.cwiseAbs().maxCoeff());
  };
  EXPECT_NE(check(mixing).find("by itself"), std::string::npos);
  const auto swallowing = [](const ConstMatrixView&, const ConstMatrixView&, MatrixView U) { U.setZero(); };
  EXPECT_NE(check(swallowing).find("a NaN state is answered"), std::string::npos);
  const auto greedy = [](const ConstMatrixView& Theta, const ConstMatrixView& X, MatrixView U) {
    good(Theta, X, U);
    if (Theta.outerStride() > Theta.rows() && Theta.rows() > 1) U(0, 0) += 0 * Theta.data()[2 * Theta.outerStride()];
  };
  EXPECT_EQ(check_policy(Made(greedy, 2), small_task()).at(0),
            "reads more than its parameters() columns of θ and its rows");
}

TEST(CheckPolicy, SizesMustFitTheTask) {
  EXPECT_EQ(check_policy(Made(good, 0, 2), small_task()),
            (std::vector<std::string>{"parameters() = 0, must be ≥ 1", "actions() = 2, must be the task's 1"}));
}

}  // namespace
}  // namespace rehearse::testing
