#include "rehearse/system/workers.hpp"

#include <cmath>
#include <functional>
#include <utility>

#include <gtest/gtest.h>

namespace rehearse::system {
namespace {

/// Counts the rows that it is given. It answers no batch that has a row whose state is in `bad`; with `by_row`, all
/// before that.
struct Script {
  std::vector<double> bad;
  bool by_row = false, costly = false, declines = false;
  Index asked = 0, started = 0, left = 0, ended = 0;
  Index left_before = 0;  // workers that had left when the first of them was destroyed
};

class ScriptedWorker final : public Worker {
 public:
  explicit ScriptedWorker(Script& script) : script_(script) { ++script_.started; }
  ~ScriptedWorker() override {
    if (script_.ended++ == 0) script_.left_before = script_.left;
  }
  ScriptedWorker(const ScriptedWorker&) = delete;
  ScriptedWorker& operator=(const ScriptedWorker&) = delete;

  Index change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) override {
    ++script_.asked;
    dX = X + U;
    for (Index i = 0; i < X.rows(); ++i)
      for (const double bad : script_.bad)
        if (X(i, 0) == bad) return script_.by_row ? i : 0;
    return X.rows();
  }
  std::string problem() const override { return "scripted"; }
  bool costly() const override { return script_.costly; }
  bool declined() const override { return script_.declines; }
  void leave() noexcept override { ++script_.left; }

 private:
  Script& script_;
};

Matrix asked_of(Script& script, Index rows, Index patience = 0) {
  const Workers workers({.start = [&script] { return std::make_unique<ScriptedWorker>(script); },
                         .row_by_row = script.by_row,
                         .patience = patience});
  Matrix X(rows, 1), dX(rows, 1);
  for (Index i = 0; i < rows; ++i) X(i, 0) = static_cast<double>(i);
  workers.change(X, Matrix::Ones(rows, 1), {}, dX);
  return dX;
}

TEST(Workers, TheRowsThatAreToBlameAreNaNAndNoOthers) {
  for (const bool by_row : {false, true})
    for (const std::vector<double>& bad : std::vector<std::vector<double>>{{}, {0}, {12}, {5, 6}, {0, 3, 4, 11, 12}}) {
      Script script{.bad = bad, .by_row = by_row};
      const Matrix dX = asked_of(script, 13);
      for (Index i = 0; i < 13; ++i) {
        const bool is_bad = std::find(bad.begin(), bad.end(), static_cast<double>(i)) != bad.end();
        EXPECT_EQ(std::isnan(dX(i, 0)), is_bad) << i;
        if (!is_bad) {
          EXPECT_EQ(dX(i, 0), static_cast<double>(i) + 1);
        }
      }
      EXPECT_EQ(script.started,
                by_row ? 1 + 2 * static_cast<Index>(bad.size()) - (bad.size() && bad.back() == 12) : script.started);
    }
}

TEST(Workers, ABatchThatTakesLongIsHalvedAtOnce) {
  Script quick{.bad = {3}}, costly{.bad = {3}, .costly = true};
  asked_of(quick, 16), asked_of(costly, 16);
  EXPECT_LT(costly.asked, quick.asked);
}

TEST(Workers, OneThatDeclinesIsKeptAndNotAskedForTheSameRowAgain) {
  Script quick{.bad = {3}}, declines{.bad = {3}, .declines = true};
  const Matrix dX = asked_of(declines, 16);
  EXPECT_EQ(dX.array().isNaN().count(), 1);
  EXPECT_TRUE(std::isnan(dX(3, 0)));
  EXPECT_EQ(declines.started, 1);
  asked_of(quick, 16);
  EXPECT_EQ(declines.asked, quick.asked - 2) << "the batch and the row are not asked twice";
  Script always{.bad = {0, 1, 2, 3, 4, 5, 6, 7}, .declines = true};
  EXPECT_THROW(asked_of(always, 8, 6), Unavailable) << "no row was ever answered";
  EXPECT_EQ(always.started, 1);
}

TEST(Workers, ManyBadRowsSideBySideTakeFewMoreWorkersThanTheyAre) {
  Script script;
  for (Index i = 100; i < 200; ++i) script.bad.push_back(static_cast<double>(i));
  EXPECT_EQ(asked_of(script, 256).array().isNaN().count(), 100);
  EXPECT_LT(script.started, 3 * 100 + 40);
}

TEST(Workers, RowsThatAreTheSameAsABadOneAreNotAskedForAgain) {
  for (const bool by_row : {false, true}) {
    Script once{.bad = {0}, .by_row = by_row, .costly = true}, often = once;
    const auto ask = [](Script& script, const Matrix& X) {
      Matrix dX(X.rows(), 1);
      Workers({.start = [&script] { return std::make_unique<ScriptedWorker>(script); }, .row_by_row = script.by_row})
          .change(X, Matrix::Ones(X.rows(), 1), {}, dX);
      return dX;
    };
    ask(once, Matrix{{0}});
    EXPECT_EQ(ask(often, Matrix::Zero(64, 1)).array().isNaN().count(), 64);
    EXPECT_LE(often.asked, once.asked + 6) << "the halving of the batch";
    const Matrix dX = ask(often, Matrix{{0}, {1}, {0}, {2}});
    EXPECT_TRUE(std::isnan(dX(2, 0)));
    EXPECT_EQ(dX(1, 0), 2);
    EXPECT_EQ(dX(3, 0), 3);
  }
}

TEST(Workers, PatienceEnds) {
  Script script{.bad = {0, 1, 2, 3, 4, 5, 6, 7}};
  EXPECT_THROW(asked_of(script, 8, 6), Unavailable) << "no row was ever answered";
  script.bad = {0, 1, 3, 4, 5, 6, 7};
  EXPECT_TRUE(std::isnan(asked_of(script, 8, 6)(7, 0))) << "row 2 is still answered";
}

TEST(Workers, PatienceEndsInCallsOfOneRow) {
  Script script{.bad = {1}};
  const Workers workers({.start = [&script] { return std::make_unique<ScriptedWorker>(script); }, .patience = 6});
  const auto ask = [&](double x) {
    Matrix dX(1, 1);
    workers.change(Matrix::Constant(1, 1, x), Matrix::Ones(1, 1), {}, dX);
    return dX(0);
  };
  EXPECT_EQ(ask(0), 1);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(std::isnan(ask(1))) << "row 0 is still answered";
  script.bad = {0, 1};
  EXPECT_THROW(
      {
        for (int i = 0; i < 6; ++i) ask(1);
      },
      Unavailable);
}

TEST(Workers, AllLeaveBeforeTheFirstIsWaitedFor) {
  Script script;
  {
    std::function<void()> ask;
    bool within = false;
    const Workers workers({.start = [&] {
      if (!std::exchange(within, true)) ask();  // a call within a call takes a worker of its own
      return std::make_unique<ScriptedWorker>(script);
    }});
    ask = [&] {
      Matrix dX(1, 1);
      workers.change(Matrix::Ones(1, 1), Matrix::Ones(1, 1), {}, dX);
    };
    ask();
    EXPECT_EQ(script.started, 2);
    EXPECT_EQ(script.ended, 0);
  }
  EXPECT_EQ(script.left_before, 2);
  EXPECT_EQ(script.ended, 2);
}

}  // namespace
}  // namespace rehearse::system
