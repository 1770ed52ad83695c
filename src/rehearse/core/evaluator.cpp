#include "rehearse/core/evaluator.hpp"

#include <atomic>
#include <exception>
#include <mutex>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "rehearse/core/events.hpp"
#include "rehearse/core/processor.hpp"

#if defined(__SANITIZE_THREAD__)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace rehearse {
namespace {

/// A mark for the thread sanitizer: all before `publish` happened before all after `observe`; else it does nothing. The
/// sanitizer cannot see how oneTBB begins and joins tasks, since Debian's library is built without it.
struct Mark {
#if defined(__SANITIZE_THREAD__)
  void publish() { __tsan_release(this); }
  void observe() { __tsan_acquire(this); }
#else
  void publish() {}
  void observe() {}
#endif
};

class SerialEvaluator final : public Evaluator {
 public:
  SerialEvaluator() { require_processor(); }

  void for_each(Index n, const std::function<void(Index)>& task) const override {
    for (Index i = 0; i < n; ++i) task(i);
  }
  int concurrency() const override { return 1; }
};

constexpr std::size_t kMostThreads = 4096;

class ThreadEvaluator final : public Evaluator {
 public:
  explicit ThreadEvaluator(int threads) : arena_(threads) {
    require_processor();
    allow_more_threads_than_cores();
  }

  void for_each(Index n, const std::function<void(Index)>& task) const override {
    if (n == 1) return task(0);
    std::atomic<Index> first_failure = n;
    std::exception_ptr failure;  // of that task
    std::mutex failing;
    const auto guarded = [&](Index i) {
      if (i > first_failure) return;  // nobody would see its result: a simulator that hangs takes long each time
      try {
        task(i);
      } catch (...) {
        const std::lock_guard one_at_a_time(failing);
        if (i < first_failure) first_failure = i, failure = std::current_exception();
      }
    };
    Mark begun, ended;
    const auto run = [&](const tbb::blocked_range<Index>& range) {
      begun.observe();
      for (Index i = range.begin(); i < range.end(); ++i) guarded(i);
      ended.publish();
    };
    begun.publish();
    arena_.execute([&] { tbb::parallel_for(tbb::blocked_range<Index>(0, n, 1), run, tbb::simple_partitioner()); });
    ended.observe();
    if (failure) std::rethrow_exception(failure);
  }

  int concurrency() const override { return arena_.max_concurrency(); }

 private:
  /// Raises oneTBB's limit of threads, which else prints a warning. One object for the process, because of several the
  /// smallest limit holds.
  static void allow_more_threads_than_cores() {
    static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kMostThreads);
  }

  mutable tbb::task_arena arena_;
};

class StoppableEvaluator final : public Evaluator {
 public:
  StoppableEvaluator(std::shared_ptr<const Evaluator> evaluator, std::function<bool()> stop)
      : evaluator_(std::move(evaluator)), stop_(std::move(stop)) {}

  void for_each(Index n, const std::function<void(Index)>& task) const override {
    const auto asking = [&](Index i) {
      stop_if_asked();
      task(i);
    };
    evaluator_->for_each(n, asking);
  }
  void stop_if_asked() const override {
    if (stop_()) throw Interrupted{};
  }
  int concurrency() const override { return evaluator_->concurrency(); }

 private:
  std::shared_ptr<const Evaluator> evaluator_;
  std::function<bool()> stop_;
};

}  // namespace

std::shared_ptr<const Evaluator> make_stoppable(std::shared_ptr<const Evaluator> evaluator,
                                                std::function<bool()> stop) {
  return std::make_shared<StoppableEvaluator>(std::move(evaluator), std::move(stop));
}

const Evaluator& serial_evaluator() {
  static const SerialEvaluator evaluator;
  return evaluator;
}

std::unique_ptr<Evaluator> make_thread_evaluator(int threads) {
  if (threads == 0) threads = tbb::info::default_concurrency();
  if (threads == 1) return std::make_unique<SerialEvaluator>();
  return std::make_unique<ThreadEvaluator>(threads);
}

}  // namespace rehearse
