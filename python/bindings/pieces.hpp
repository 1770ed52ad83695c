#pragma once
// The pieces alone, with arrays: GPs and moment matching, CMA-ES, MAP-Elites.

#include <pybind11/pybind11.h>

namespace rehearse::python {

void add_gp(pybind11::module_& module);
void add_search(pybind11::module_& module);

}  // namespace rehearse::python
