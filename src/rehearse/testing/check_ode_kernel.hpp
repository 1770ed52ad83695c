#pragma once

#include <string>
#include <vector>

#include "rehearse/system/ode.hpp"

namespace rehearse::testing {

/// Checks a kernel at a state and φ of ones. Returns what is wrong, a line each: one that keeps the address of
/// Highway's chooser asks the processor for its instruction sets at every call, which takes far longer than the
/// equations. One thread.
std::vector<std::string> check_ode_kernel(system::OdeKernel (*kernel)());

}  // namespace rehearse::testing
