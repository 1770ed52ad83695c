#include "rehearse/core/evaluator.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/core/events.hpp"

namespace rehearse {
namespace {

class EachEvaluator : public ::testing::TestWithParam<int> {
 protected:
  std::unique_ptr<Evaluator> evaluator_ = make_thread_evaluator(GetParam());
};

TEST_P(EachEvaluator, CallsEveryTaskOnce) {
  std::vector<std::atomic<int>> calls(1000);
  evaluator_->for_each(1000, [&](Index i) { ++calls[static_cast<std::size_t>(i)]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST_P(EachEvaluator, NothingToDo) {
  evaluator_->for_each(0, [](Index) { FAIL(); });
}

TEST_P(EachEvaluator, TheFirstExceptionInOrderComesBack) {
  for (int repetition = 0; repetition < 20; ++repetition) {
    try {
      evaluator_->for_each(100, [](Index i) {
        if (i % 30 == 17) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "17");
    }
  }
  int calls = 0;
  evaluator_->for_each(1, [&](Index) { ++calls; });
  EXPECT_EQ(calls, 1) << "it can be used again";
}

TEST_P(EachEvaluator, LeavesOutWhatComesAfterAFailure) {
  constexpr int kTasks = 1000;
  std::atomic<int> begun = 0;
  std::atomic<bool> failed = false;
  const auto task = [&](Index i) {
    ++begun;
    if (i == 0) failed = true;
    if (i == 0) throw std::runtime_error("0");
    while (!failed) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // until the failure is known
  };
  EXPECT_THROW(evaluator_->for_each(kTasks, task), std::runtime_error);
  EXPECT_LT(begun, kTasks);
}

TEST_P(EachEvaluator, MayBeCalledFromWithinATask) {
  Vector sums(20);
  evaluator_->for_each(20, [&](Index i) {
    Vector products(50);
    evaluator_->for_each(50, [&](Index j) { products(j) = static_cast<double>(i * j); });
    sums(i) = products.sum();
  });
  for (Index i = 0; i < 20; ++i) EXPECT_EQ(sums(i), static_cast<double>(i * 49 * 50 / 2));
}

TEST_P(EachEvaluator, NeverRunsMoreThanItSays) {
  std::atomic<int> running{0}, most{0};
  evaluator_->for_each(200, [&](Index) {
    int now = ++running;
    int seen = most;
    while (seen < now && !most.compare_exchange_weak(seen, now)) {
    }
    --running;
  });
  EXPECT_LE(most, evaluator_->concurrency());
}

TEST_P(EachEvaluator, MayBeStoppedBetweenTasksAndWithin) {
  std::atomic<bool> stop = false;
  std::atomic<Index> begun = 0, ended = 0;
  const auto stoppable = make_stoppable(make_thread_evaluator(GetParam()), [&] { return stop.load(); });
  const auto task = [&](Index) {
    if (++begun == 10) stop = true;
    stoppable->stop_if_asked();
    ++ended;
  };
  EXPECT_EQ(stoppable->concurrency(), GetParam());
  EXPECT_THROW(stoppable->for_each(100000, task), Interrupted);
  EXPECT_LE(begun, 10 + GetParam()) << "those that had begun";
  EXPECT_LT(ended, begun);
  EXPECT_THROW(stoppable->for_each(3, [&](Index) { FAIL(); }), Interrupted);
  stop = false;
  Vector results(3);
  stoppable->for_each(3, [&](Index i) { results(i) = static_cast<double>(i); });
  EXPECT_EQ(results, (Vector{{0, 1, 2}}));
}

INSTANTIATE_TEST_SUITE_P(Threads, EachEvaluator, ::testing::Values(1, 2, 4));

TEST(Evaluator, SaysHowManyRunAtOnce) {
  EXPECT_EQ(serial_evaluator().concurrency(), 1);
  EXPECT_EQ(make_thread_evaluator(1)->concurrency(), 1);
  EXPECT_EQ(make_thread_evaluator(3)->concurrency(), 3);
  EXPECT_GE(make_thread_evaluator(0)->concurrency(), 1);
}

TEST(Evaluator, MoreThreadsThanCoresPrintNothing) {
  ::testing::internal::CaptureStderr();
  make_thread_evaluator(64)->for_each(64, [](Index) {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace rehearse
