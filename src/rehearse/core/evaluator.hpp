#pragma once

#include <functional>
#include <memory>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// Spreads independent tasks over threads. Handed in from outside; rooms never start threads themselves. The results of
/// a task must depend on its number alone: then they are the same for any number of threads.
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /// Calls task(i) once for each i in 0..n−1 and returns when all have ended. The first exception of a task (in order
  /// of i) is thrown again here; tasks after it may be left out. May be called from within a task.
  virtual void for_each(Index n, const std::function<void(Index)>& task) const = 0;

  /// The number of tasks that run at once; must not affect results.
  virtual int concurrency() const = 0;

  /// Throws Interrupted if the user asked to stop; long tasks call it as they go. Any thread.
  virtual void stop_if_asked() const {}
};

/// The evaluator that runs one task after the other, on the calling thread.
const Evaluator& serial_evaluator();

/// The same evaluator, which calls `stop` before each task; once it returns true, Interrupted (events.hpp) is thrown.
/// stop: called on any thread.
std::shared_ptr<const Evaluator> make_stoppable(std::shared_ptr<const Evaluator> evaluator, std::function<bool()> stop);

/// An evaluator that runs tasks on `threads` threads (≥ 1) of oneTBB; 0 means all cores.
std::unique_ptr<Evaluator> make_thread_evaluator(int threads);

}  // namespace rehearse
