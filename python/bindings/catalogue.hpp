#pragma once

#include <pybind11/pybind11.h>

namespace rehearse::python {

/// Functions that list what there is: robots, learners and presets, and the options of one of them.
void add_catalogue(pybind11::module_& module);

}  // namespace rehearse::python
