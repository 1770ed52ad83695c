#pragma once

#include <pybind11/pybind11.h>

namespace rehearse::python {

/// Episodes of a run's policy that are no trials.
void add_evaluation(pybind11::module_& module);

}  // namespace rehearse::python
