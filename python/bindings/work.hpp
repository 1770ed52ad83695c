#pragma once
// Work of C++ on behalf of Python: without the interpreter's lock, stopped by Ctrl-C, with the exceptions of its
// functions.

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/bindings/interruption.hpp"
#include "python/bindings/robot.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/run_options.hpp"

namespace rehearse::python {

/// listener: function(event), a dict; None: nobody listens. threads: 0 are all cores.
struct Settings {
  int threads = 0;
  py::object listener = py::none();
};

/// own: the robot, with a Failure for this work alone.
using Work = std::function<void(const Robot& own, const experiment::RunOptions& options)>;

/// Does the work and raises what a function of Python raised, as it was; KeyboardInterrupt where Ctrl-C stopped it.
void work_with(const Robot& robot, const Settings& settings, const Work& work);

/// Gives the lines as Python's warnings, about the line that called the function of Python that called this.
void warn(const std::vector<std::string>& lines);

/// Lets ten events of progress a second pass: each waits for Python.
class Throttle {
 public:
  bool passes() {
    const auto now = Clock::now();
    if (now < next_) return false;
    next_ = now + std::chrono::milliseconds(100);
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point next_ = Clock::now();
};

/// An event of progress as Python has it.
py::dict progress_of(Index trial, const Progress& progress);

/// A trial as Python has it.
py::dict trial_of(const experiment::TrialRecord& trial, const std::vector<std::string>& parameters);

}  // namespace rehearse::python
