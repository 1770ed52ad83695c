#include "rehearse/testing/check_simulator.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/system/plain_kernel.hpp"
#include "rehearse/testing/hostile.hpp"

namespace rehearse::testing {
namespace {

/// A simulator of two states and one action, given by its batch function.
class MadeSimulator final : public system::Simulator {
 public:
  using Change = std::function<void(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView dX)>;
  explicit MadeSimulator(Change change) : change_(std::move(change)) {}
  const ParameterSpace& parameters() const override { return space_; }
  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) const override {
    change_(X, U, dX);
  }

 private:
  Change change_;
  ParameterSpace space_;
};

const Matrix kX = Matrix::Random(11, 2), kU = Matrix::Random(11, 1);

/// True if one of the lines holds this text.
bool complains(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines)
    if (line.find(text) != std::string::npos) return true;
  return false;
}

std::vector<std::string> check_made_simulator(MadeSimulator::Change change) {
  return check_simulator(MadeSimulator(std::move(change)), kX, kU, {});
}

TEST(CheckSimulator, AcceptsAGoodOne) {
  const auto good = [](const ConstMatrixView& X, const ConstMatrixView& U, MatrixView dX) {
    dX = X.colwise() + U.col(0);
  };
  EXPECT_EQ(check_made_simulator(good), std::vector<std::string>{});
}

TEST(CheckSimulator, AcceptsThePendubotAndAnyEquation) {
  const auto scenario = robots::pendubot::make({});
  const Matrix X = 5 * Matrix::Random(21, 4), U = 3 * Matrix::Random(21, 1);
  EXPECT_EQ(check_simulator(*scenario.oracle, X, U, scenario.oracle->parameters().values()),
            std::vector<std::string>{});
  const auto pull = [](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) { dxdt = -x.array() + u(0); };
  EXPECT_EQ(check_simulator(*system::make_ode_simulator(pull, {}, 0.1, 4), kX, kU, {}), std::vector<std::string>{});
}

TEST(CheckSimulator, AcceptsOneThatFailsInAFewRows) {
  const auto pull = [](const Vector& x, const Vector& u, const Vector&, Vector& dxdt) { dxdt = -x.array() + u(0); };
  const auto simulator = system::make_ode_simulator(pull, {}, 0.1, 4);
  for (const Harm harm : {Harm::nan, Harm::huge, Harm::exception})
    EXPECT_EQ(check_simulator(*make_hostile(simulator, harm, 1e-6), kX, kU, {}), std::vector<std::string>{});
}

TEST(CheckSimulator, FindsRowsThatKnowOfEachOther) {
  const auto mean = [](const ConstMatrixView& X, const ConstMatrixView&, MatrixView dX) {
    dX = X.rowwise() - X.colwise().mean();
  };
  EXPECT_TRUE(complains(check_made_simulator(mean), "by itself"));
  EXPECT_TRUE(complains(check_made_simulator(mean), "disturb other rows"));
}

TEST(CheckSimulator, FindsMemory) {
  auto calls = std::make_shared<std::atomic<int>>(0);
  const auto counting = [calls](const ConstMatrixView& X, const ConstMatrixView&, MatrixView dX) {
    dX = X * (1 + 1e-15 * ++*calls);
  };
  EXPECT_TRUE(complains(check_made_simulator(counting), "repeated"));
}

TEST(CheckSimulator, FindsSharedScratch) {
  const auto racing = [](const ConstMatrixView& X, const ConstMatrixView&, MatrixView dX) {
    static std::atomic<int> inside{0};
    const bool alone = ++inside == 1;  // what a race does, without one
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    dX = alone && inside == 1 ? X : 2 * X;
    --inside;
  };
  EXPECT_TRUE(complains(check_made_simulator(racing), "several threads"));
}

TEST(CheckSimulator, FindsNanThatIsSwallowed) {
  const auto swallowing = [](const ConstMatrixView& X, const ConstMatrixView&, MatrixView dX) {
    dX = X.unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; });
  };
  EXPECT_TRUE(complains(check_made_simulator(swallowing), "answered with numbers"));
}

TEST(CheckSimulator, SaysWhenTheSampleIsUnfit) {
  const auto good = [](const ConstMatrixView& X, const ConstMatrixView&, MatrixView dX) { dX = X; };
  EXPECT_TRUE(complains(check_simulator(MadeSimulator(good), kX.topRows(1), kU.topRows(1), {}), "≥ 2"));
  EXPECT_TRUE(complains(check_simulator(MadeSimulator(good), kX, kU, Vector::Ones(2)), "phi has 2 values, must be 0"));
  const auto failing = [](const ConstMatrixView&, const ConstMatrixView&, MatrixView) { throw 1; };
  EXPECT_TRUE(complains(check_made_simulator(failing), "cannot be simulated"));
}

}  // namespace
}  // namespace rehearse::testing
