#include "rehearse/system/isolation.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace rehearse::system {
namespace {

/// dX = X + u + φ. A row whose action is −1 ends the process, −2 waits for ever, −3 throws.
std::shared_ptr<const Simulator> hostile() {
  const auto change = [](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
    if (U(0, 0) == -1) std::abort();
    while (U(0, 0) == -2) std::this_thread::sleep_for(std::chrono::seconds(1));
    if (U(0, 0) == -3) throw 7;
    if (U(0, 0) == 5) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    dX = (X.array() + U(0, 0) + phi(0)).matrix();
  };
  return make_simulator(ParameterSpace({Parameter::continuous("a", 0, {-1, 1})}), change);
}

const Vector kShift{{0.25}};

Matrix numbered(Index rows) {
  Matrix X(rows, 3);
  for (Index i = 0; i < rows; ++i) X.row(i).setConstant(static_cast<double>(i));
  return X;
}

/// All rows but the bad ones are right, and these are NaN.
void expect_answers(const Simulator& simulator, const Matrix& U) {
  const Matrix X = numbered(U.rows());
  Matrix dX = Matrix::Zero(X.rows(), X.cols());
  simulator.change(X, U, kShift, dX);
  for (Index i = 0; i < X.rows(); ++i) {
    if (U(i, 0) < 0) {
      EXPECT_TRUE(dX.row(i).array().isNaN().all()) << i;
    } else {
      EXPECT_EQ(dX.row(i), (X.row(i).array() + U(i, 0) + 0.25).matrix()) << i;
    }
  }
}

TEST(Isolated, AnswersAsTheSimulatorDoes) {
  const auto simulator = isolated(hostile());
  EXPECT_EQ(simulator->parameters().names(), hostile()->parameters().names());
  expect_answers(*simulator, Matrix::Ones(100, 2));
  expect_answers(*simulator, Matrix::Ones(1, 2));
  expect_answers(*simulator, Matrix::Ones(0, 2));
}

TEST(Isolated, AProcessThatCannotBeMadeIsNoRowOfNaN) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer looks at exceptions through a pipe, for which no file is left";
#endif
  const auto simulator = isolated(hostile());
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  const rlimit few{3, files.rlim_max};
  setrlimit(RLIMIT_NOFILE, &few);
  Matrix dX(2, 3);
  EXPECT_THROW(change_contained(*simulator, numbered(2), Matrix::Ones(2, 2), kShift, dX), Unavailable);
  setrlimit(RLIMIT_NOFILE, &files);
  expect_answers(*simulator, Matrix::Ones(2, 2));
}

TEST(Isolated, RowsThatEndTheProcessThrowOrHangComeBackAsNaN) {
  const auto simulator = isolated(hostile(), 0.5);
  for (const double harm : {-1.0, -2.0, -3.0}) {
    Matrix U = Matrix::Ones(6, 1);
    U(0, 0) = U(3, 0) = U(4, 0) = harm;
    expect_answers(*simulator, U);
  }
  expect_answers(*simulator, Matrix::Constant(3, 1, -1));
}

TEST(Isolated, SeveralThreadsMayCall) {
  const auto simulator = isolated(hostile());
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&simulator, t] {
      Matrix U = Matrix::Constant(50, 1, t);
      U(10 * t, 0) = -1;
      for (int i = 0; i < 3; ++i) expect_answers(*simulator, U);
    });
  for (std::thread& thread : threads) thread.join();
}

/// Processes that were made by a thread of this one.
std::vector<pid_t> children() {
  std::vector<pid_t> list;
  const std::string name = "/proc/self/task/" + std::to_string(gettid()) + "/children";
  std::ifstream file(name);
  for (pid_t child = 0; file >> child;) list.push_back(child);
  return list;
}

TEST(Isolated, AProcessThatIsKilledChangesNoNumber) {
  const auto simulator = isolated(hostile());
  expect_answers(*simulator, Matrix::Ones(1, 1));
  const std::vector<pid_t> first = children();
  ASSERT_EQ(first.size(), 1u);
  kill(first.front(), SIGKILL);  // while it waits
  expect_answers(*simulator, Matrix::Ones(20, 1));
  const std::vector<pid_t> second = children();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_NE(second, first);
  std::thread killer([worker = second.front()] {  // while it works: 40 rows of 5 ms
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    kill(worker, SIGKILL);
  });
  expect_answers(*simulator, Matrix::Constant(40, 1, 5));
  killer.join();
}

TEST(Isolated, NoProcessIsLeftBehind) {
  auto simulator = isolated(hostile());
  expect_answers(*simulator, Matrix::Ones(5, 1));
  EXPECT_EQ(children().size(), 1u);
  simulator.reset();
  EXPECT_TRUE(children().empty());
}

}  // namespace
}  // namespace rehearse::system
