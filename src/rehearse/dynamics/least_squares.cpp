#include "rehearse/dynamics/least_squares.hpp"

#include <limits>

namespace rehearse::dynamics {

Identified least_squares(const Residuals& residuals, const prior::Prior& prior, const std::optional<Vector>& start,
                         const optim::SubplexOptions& options) {
  const double charge = residuals.scale().squaredNorm();
  const auto objective = [&](const Vector& phi) {
    const Residuals::Rows rows = residuals.at(&prior, phi);
    if (!rows.inputs) return -std::numeric_limits<double>::infinity();
    const double charged = static_cast<double>(rows.left_out) * charge;
    return -(rows.targets.squaredNorm() + charged) / static_cast<double>(residuals.size());
  };
  return identify(prior.space, start, objective, options);
}

}  // namespace rehearse::dynamics
