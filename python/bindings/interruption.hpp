#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "python/bindings/calls.hpp"

namespace rehearse::python {

/// Whether work is to stop: a function of Python failed, or Ctrl-C was pressed, which Python tells the thread that
/// asks it alone, the one that made this. Any thread may ask.
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
