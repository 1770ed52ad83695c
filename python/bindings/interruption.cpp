#include "python/bindings/interruption.hpp"

#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"

namespace rehearse::python {
namespace {

std::atomic<int> works_in_flight = 0;
std::atomic<bool> interpreter_ends = false;
std::thread::id ending_thread;  // functions at its exit may still work there

bool ends_for(std::thread::id worker) { return interpreter_ends && worker != ending_thread; }

constexpr auto kLongestWait = std::chrono::seconds(5);  // for a function of a user that does not return

void wait_for_work() {
  ending_thread = std::this_thread::get_id();
  interpreter_ends = true;
  const auto until = std::chrono::steady_clock::now() + kLongestWait;
  while (works_in_flight > 0 && std::chrono::steady_clock::now() < until) {
    {
      const py::gil_scoped_release unlocked;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

}  // namespace

Unlocked::InFlight::InFlight() {
  if (ends_for(std::this_thread::get_id())) throw Interrupted();
  ++works_in_flight;
}

Unlocked::InFlight::~InFlight() { --works_in_flight; }

void stop_work_at_exit() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_work));
  const auto in_child = [] {  // no other thread goes on there
    works_in_flight = 0;
    forget_other_threads();
  };
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") = py::cpp_function(in_child));
}

bool Interruption::asked() {
  if (asked_ || ends_for(owner_) || failure_->any()) return asked_ = true;
  if (std::this_thread::get_id() != owner_ || Clock::now() < next_) return false;
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) {
    failure_->keep(py::error_already_set(), "rehearse");
    asked_ = true;
  }
  next_ = Clock::now() + std::chrono::milliseconds(50);
  return asked_;
}

void require_outside_of_robots() {
  if (in_function_of_robot())
    throw InvalidInput("a function of a robot may not begin work on robots: it is called in the middle of some");
}

void do_unlocked(const std::shared_ptr<Failure>& failure,
                 const std::function<void(const std::function<bool()>& stop)>& work) {
  const auto interruption = std::make_shared<Interruption>(failure);
  try {
    const Unlocked unlocked;
    work([interruption] { return interruption->asked(); });
  } catch (...) {
    failure->raise_if_any();
    throw;
  }
  failure->raise_if_any();
}

}  // namespace rehearse::python
