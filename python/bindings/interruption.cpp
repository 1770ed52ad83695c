#include "python/bindings/interruption.hpp"

namespace rehearse::python {

bool Interruption::asked() {
  if (asked_ || failure_->any()) return asked_ = true;
  if (std::this_thread::get_id() != owner_ || Clock::now() < next_) return false;
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) {
    failure_->keep(py::error_already_set(), "rehearse");
    asked_ = true;
  }
  next_ = Clock::now() + std::chrono::milliseconds(50);
  return asked_;
}

}  // namespace rehearse::python
