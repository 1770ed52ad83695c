#pragma once

#include <pybind11/pybind11.h>

namespace rehearse::python {

/// Files that users name: pages and policies. A file of somebody else is left as it is.
void add_outputs(pybind11::module_& module);

}  // namespace rehearse::python
