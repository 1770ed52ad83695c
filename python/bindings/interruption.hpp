#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "python/bindings/calls.hpp"

namespace rehearse::python {

/// Tells work to stop: a Python function failed, or Ctrl-C was pressed. Python reports Ctrl-C only to the thread that
/// made this object. Any thread may call `asked`.
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

}  // namespace rehearse::python
