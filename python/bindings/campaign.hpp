#pragma once

#include <pybind11/pybind11.h>

namespace rehearse::python {

void add_campaign(pybind11::module_& module);

}  // namespace rehearse::python
