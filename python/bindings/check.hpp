#pragma once

#include <pybind11/pybind11.h>

namespace rehearse::python {

/// The function `check`, for Python's rehearse.check.
void add_check(pybind11::module_& module);

}  // namespace rehearse::python
