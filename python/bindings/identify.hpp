#pragma once

#include <pybind11/pybind11.h>

namespace rehearse::python {

/// A robot from logs alone.
void add_identify(pybind11::module_& module);

}  // namespace rehearse::python
