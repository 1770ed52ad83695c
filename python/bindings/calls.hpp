#pragma once
// Functions of Python, called from any thread: arrays in, arrays out, exceptions kept.

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "rehearse/core/types.hpp"

namespace rehearse::python {

namespace py = pybind11;

/// An object that threads without the interpreter's lock may copy and let go.
using Shared = std::shared_ptr<py::object>;
Shared shared(py::object object);

/// The first exception that Python code raised while C++ was at work. Any thread.
class Failure {
 public:
  /// where: what was called, for the exception's notes. The interpreter is locked.
  void keep(const py::error_already_set& error, const std::string& where);
  bool any() const;

  /// Raises it as it was, if there is one, and forgets it: its traceback holds whoever called. The interpreter is
  /// locked.
  void raise_if_any();

  /// Forgets it unless it is KeyboardInterrupt. The interpreter is locked.
  void forget_errors();

 private:
  std::optional<py::error_already_set> take();

  mutable std::mutex mutex_;  // never held while Python runs
  std::optional<py::error_already_set> first_;
};

/// A new array, which its receiver may keep.
py::array_t<double> to_array(const ConstMatrixView& X);
py::array_t<double> to_vector(const ConstVectorView& x);

/// A function of Python and where its exceptions go.
struct Callable {
  Shared function;
  std::string name;  // "reward"
  std::shared_ptr<Failure> failure;
};

/// Calls what Python needs a lock for, between the steps of work. An exception is kept, and becomes
/// system::Unavailable, which ends a run.
void call_between(const Callable& of, const std::function<void(const py::object& function)>& work);

/// The same for a function of a robot, in the middle of work: this thread's memory is in use. One thread at a time.
void call(const Callable& of, const std::function<void(const py::object& function)>& work);

/// The same for an environment, by any number of threads: robots of several runs move at once.
void call_at_once(const Callable& of, const std::function<void(const py::object& function)>& work);

/// In the child of a fork, where no other thread goes on.
void forget_other_threads();

/// True while this thread is in a function of a robot.
bool in_function_of_robot();

/// The number that a function returned. Raises ValueError.
double number_of(const py::object& result, const std::string& name);

/// The numbers that a function returned, into a vector or a matrix of the right size. Raises ValueError.
void write_result(const py::object& result, const std::string& name, VectorView values);
void write_truths(const py::object& result, const std::string& name, VectorView values);  // True and False alone
void write_result(const py::object& result, const std::string& name, MatrixView values);

}  // namespace rehearse::python
