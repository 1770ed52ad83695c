#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// Spreads independent tasks over threads (or MPI ranks). Handed in from outside; rooms never start threads themselves.
/// The results of a task must depend on its number alone: then they are the same for any number of workers.
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /// Calls task(i, results.col(i)) once for each column i and returns when every column is filled, here and on every
  /// rank. The first exception of a task (in order of i) is thrown again here. May be called from within a task.
  virtual void evaluate(const std::function<void(Index, VectorView)>& task, MatrixView results) const = 0;

  /// Calls task(i) once for each i in 0..n−1 on the threads of this process alone: for tasks that change state kept
  /// here, which every rank must do for itself. Exceptions as above.
  virtual void for_each(Index n, const std::function<void(Index)>& task) const = 0;

  /// What `work` returns, called once in all: with ranks on rank 0 alone, and every rank returns what it returned or
  /// throws what it threw. For what cannot be shared, the plant and files. step: what it is, "episode 3"; ranks that
  /// are at different steps all throw. Not from within a task.
  virtual std::string once(std::string_view /*step*/, const std::function<std::string()>& work) const { return work(); }

  /// How many tasks run at once; must not decide results.
  virtual int concurrency() const = 0;

  /// Throws Interrupted if the user asked to stop; long tasks call it as they go. Any thread.
  virtual void stop_if_asked() const {}
};

/// One after the other, on the calling thread.
const Evaluator& serial_evaluator();

/// The same evaluator, which asks `stop` before each task: once true, Interrupted comes out of whatever it was asked to
/// do. stop: any thread.
std::shared_ptr<const Evaluator> make_stoppable(std::shared_ptr<const Evaluator> evaluator, std::function<bool()> stop);

/// On `threads` threads (≥ 1) of oneTBB; 0 means all cores.
std::unique_ptr<Evaluator> make_thread_evaluator(int threads);

}  // namespace rehearse
