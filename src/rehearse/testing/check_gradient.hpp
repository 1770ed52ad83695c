#pragma once

#include <string>
#include <vector>

#include "rehearse/optim/gradient.hpp"

namespace rehearse::testing {

/// A line for each component of the gradient at x that differs from central differences (extrapolated from steps h and
/// h/2, h = `step` · max(1, |x_i|)) by more than `tolerance` · max(1, |component|); and if the value or the gradient
/// depends on whether it was called before.
std::vector<std::string> check_gradient(const optim::Differentiable& function, const Vector& x, double tolerance = 1e-6,
                                        double step = 1e-3);

}  // namespace rehearse::testing
