#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "python/bindings/calls.hpp"

namespace rehearse::python {

/// Work without the interpreter's lock, for which the interpreter waits before it ends: a daemon thread that came to
/// take the lock after that would end the process. Throws Interrupted where the interpreter is about to end in another
/// thread. The lock is held where it is made.
class Unlocked {
 public:
  Unlocked() = default;

 private:
  struct InFlight {
    InFlight();
    ~InFlight();
  };
  InFlight in_flight_;  // until the lock is there again
  py::gil_scoped_release released_;
};

/// Stops all work when the interpreter ends, and waits for it; Ctrl-C ends the waiting. Once, when the module is made.
void stop_work_at_exit();

/// Tells work to stop: a Python function failed, Ctrl-C was pressed, or the interpreter is about to end. Python reports
/// Ctrl-C only to the thread that made this object. Any thread may call `asked`.
class Interruption {
 public:
  explicit Interruption(std::shared_ptr<Failure> failure)
      : failure_(std::move(failure)), owner_(std::this_thread::get_id()) {}

  bool asked();

 private:
  using Clock = std::chrono::steady_clock;

  std::shared_ptr<Failure> failure_;
  std::thread::id owner_;
  Clock::time_point next_ = Clock::now();
  std::atomic<bool> asked_ = false;
};

/// Throws InvalidInput in a function of a robot.
void require_outside_of_robots();

/// Does the work without the interpreter's lock. stop: true once it is to end with Interrupted. Raises what a function
/// of Python raised, as it was; KeyboardInterrupt where Ctrl-C stopped it.
void do_unlocked(const std::shared_ptr<Failure>& failure,
                 const std::function<void(const std::function<bool()>& stop)>& work);

}  // namespace rehearse::python
