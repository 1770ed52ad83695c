#pragma once

#include <optional>

#include "rehearse/dynamics/identification.hpp"
#include "rehearse/dynamics/residuals.hpp"

namespace rehearse::dynamics {

/// The φ of the least mean squared one-step error. A row that fails is charged the variance of the changes, so that a φ
/// at which rows fail does not win by having fewer of them to predict.
Identified least_squares(const Residuals& residuals, const prior::Prior& prior, const std::optional<Vector>& start,
                         const optim::SubplexOptions& options);

}  // namespace rehearse::dynamics
