#include "python/bindings/calls.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "rehearse/system/simulator.hpp"

namespace rehearse::python {
namespace {

thread_local int functions_of_robots = 0;  // in which this thread is

/// Whoever has it may call functions of robots. Without it threads would take the interpreter's lock from each other
/// in the middle of functions, since NumPy gives it away in each operation: two threads took three times as long as
/// one. Never freed: after a fork the lock of a thread that is gone stays locked.
std::mutex* turn = new std::mutex;

std::unique_lock<std::mutex> wait_for_turn() {
  if (functions_of_robots > 0) return {};  // called by one of them, which has it, or by an environment
  std::unique_lock mine(*turn, std::defer_lock);
  if (PyGILState_Check() == 0) {
    mine.lock();
  } else if (!mine.try_lock()) {
    const py::gil_scoped_release unlocked;  // whoever has the turn needs it to end
    mine.lock();
  }
  return mine;
}

struct InFunction {
  InFunction() { ++functions_of_robots; }
  ~InFunction() { --functions_of_robots; }
};

using FortranArray = py::array_t<double, py::array::f_style | py::array::forcecast>;

std::string shape_of(const py::array& array) {
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) shape += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  return fmt::format("({}{})", shape, array.ndim() == 1 ? "," : "");
}

[[noreturn]] void refuse(const std::string& name, const std::string& result, const char* wanted) {
  PyErr_Clear();
  throw py::value_error(fmt::format("{} returned {}, must be {}", name, result, wanted));
}

std::string type_of(const py::object& result) {
  return result.is_none() ? "None" : py::str(py::type::of(result).attr("__name__"));
}

bool is_masked(const py::object& result) { return py::hasattr(result, "filled"); }

/// The name of what NumPy would take for numbers; empty: it has numbers alone.
std::string no_numbers(const py::array& array) {
  switch (array.dtype().kind()) {
    case 'c':
      return "complex numbers";
    case 'S':
    case 'U':
      return "texts";
    case 'm':
    case 'M':
      return "times";
    case 'O':
      break;
    default:
      return "";
  }
  for (const py::handle each : array.attr("flat")) {
    if (each.is_none()) return "None among its numbers";
    if (py::isinstance<py::str>(each) || py::isinstance<py::bytes>(each)) return "texts";
  }
  return "";
}

/// Raises ValueError where NumPy makes no array of a result. What is masked is NaN.
template <class Array>
Array array_of(const py::object& result, const std::string& name) {
  constexpr const char* kWanted = "an array of numbers";
  if (result.is_none()) refuse(name, "None", kWanted);
  const py::array given = py::array::ensure(
      is_masked(result) ? result.attr("astype")("float64").attr("filled")(py::float_(std::nan(""))) : result);
  if (given)
    if (const std::string what = no_numbers(given); !what.empty()) refuse(name, what, kWanted);
  if (const Array array = Array::ensure(given)) return array;
  refuse(name, type_of(result), kWanted);
}

}  // namespace

Shared shared(py::object object) {
  return {new py::object(std::move(object)), [](py::object* last) {
            if (!Py_IsInitialized()) return;  // the interpreter is gone, and its objects with it
            const py::gil_scoped_acquire lock;
            delete last;
          }};
}

void Failure::keep(const py::error_already_set& error, const std::string& where) {
  {
    const std::lock_guard guard(mutex_);
    if (first_) return;
    first_ = error;
  }
  // Python may let another thread run here, which may come to keep its own.
  if (py::hasattr(error.value(), "add_note")) error.value().attr("add_note")("raised in " + where);
}

bool Failure::any() const {
  const std::lock_guard guard(mutex_);
  return first_.has_value();
}

std::optional<py::error_already_set> Failure::take() {
  const std::lock_guard guard(mutex_);
  return std::exchange(first_, std::nullopt);
}

void Failure::raise_if_any() {
  if (const auto first = take()) throw py::error_already_set(*first);
}

void Failure::forget_errors() {
  if (const auto first = take(); first && first->matches(PyExc_KeyboardInterrupt)) keep(*first, "rehearse");
}

py::array_t<double> to_array(const ConstMatrixView& X) {
  py::array_t<double, py::array::f_style> array({X.rows(), X.cols()});
  Matrix::Map(array.mutable_data(), X.rows(), X.cols()) = X;
  return array;
}

py::array_t<double> to_vector(const ConstVectorView& x) {
  py::array_t<double> array(x.size());
  Vector::Map(array.mutable_data(), x.size()) = x;
  return array;
}

bool in_function_of_robot() { return functions_of_robots > 0; }

void call(const Callable& of, const std::function<void(const py::object& function)>& work) {
  const auto mine = wait_for_turn();
  call_at_once(of, work);
}

void call_at_once(const Callable& of, const std::function<void(const py::object& function)>& work) {
  const InFunction inside;
  call_between(of, work);
}

void forget_other_threads() { turn = new std::mutex; }

void call_between(const Callable& of, const std::function<void(const py::object& function)>& work) {
  const py::gil_scoped_acquire lock;
  try {
    try {
      work(*of.function);
    } catch (const py::builtin_exception& wrong) {
      wrong.set_error();
      throw py::error_already_set();
    }
  } catch (const py::error_already_set& error) {
    of.failure->keep(error, of.name);
    const std::string why =
        fmt::format("{}: {}: {}", of.name, py::str(error.type().attr("__name__")).cast<std::string>(),
                    py::str(error.value()).cast<std::string>());
    if (error.matches(PyExc_KeyboardInterrupt)) throw system::Stopped(why);
    throw system::Unavailable(why);
  }
}

double number_of(const py::object& result, const std::string& name) {
  constexpr const char* kWanted = "a number";
  const py::array array = py::array::ensure(result);
  if (array && array.size() != 1) refuse(name, "an array of shape " + shape_of(array), kWanted);
  if (array && array.dtype().kind() == 'c') refuse(name, "a complex number", kWanted);  // NumPy would drop a part
  const double number = PyFloat_AsDouble(result.ptr());  // takes no texts, as float() does
  if (!PyErr_Occurred()) return number;
  if (PyErr_ExceptionMatches(PyExc_TypeError) != 0) refuse(name, type_of(result), kWanted);
  throw py::error_already_set();
}

void write_result(const py::object& result, const std::string& name, VectorView values) {
  const FortranArray array = array_of<FortranArray>(result, name);
  const bool column = array.ndim() == 2 && array.shape(1) == 1;
  if (!(array.ndim() == 1 || column) || array.shape(0) != values.size())
    throw py::value_error(
        fmt::format("{} returned an array of shape {}, must be ({},)", name, shape_of(array), values.size()));
  values = Vector::Map(array.data(), values.size());
}

void write_truths(const py::object& result, const std::string& name, VectorView values) {
  if (is_masked(result)) throw py::value_error(name + " returned a masked array, must be truths");
  if (array_of<py::array>(result, name).dtype().kind() != 'b')
    throw py::value_error(name + " returned numbers, must be truths, one a row: states[:, 0] > 1");
  write_result(result, name, values);
}

void write_result(const py::object& result, const std::string& name, MatrixView values) {
  const FortranArray array = array_of<FortranArray>(result, name);
  if (array.ndim() != 2 || array.shape(0) != values.rows() || array.shape(1) != values.cols())
    throw py::value_error(fmt::format("{} returned an array of shape {}, must be ({}, {})", name, shape_of(array),
                                      values.rows(), values.cols()));
  values = Matrix::Map(array.data(), values.rows(), values.cols());
}

}  // namespace rehearse::python
