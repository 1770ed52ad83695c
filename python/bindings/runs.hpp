#pragma once

#include <pybind11/pybind11.h>

namespace rehearse::python {

/// Functions on run folders: learn, resume, ask, tell, and those that read them.
void add_runs(pybind11::module_& module);

}  // namespace rehearse::python
