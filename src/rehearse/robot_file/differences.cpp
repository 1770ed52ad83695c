#include "rehearse/robot_file/differences.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace rehearse::robot_file {

Matrix apart(const Matrix& one, const Matrix& other) {
  return one.binaryExpr(other, [](double a, double b) {
    if (std::isnan(a) || std::isnan(b))
      return std::isnan(a) && std::isnan(b) ? 0 : std::numeric_limits<double>::infinity();
    return std::abs(a - b);
  });
}

Vector rounding(const Matrix& X, const Matrix& dX) {
  const auto largest = [](const Matrix& rows) -> Vector {
    return rows.array().isFinite().select(rows, 0).cwiseAbs().colwise().maxCoeff().transpose();
  };
  return 1e-14 * largest(X) + 1e-10 * largest(dX);
}

std::string difference(const Task& task, const Matrix& distances, const Vector& tolerated) {
  if (distances.rows() == 0) return {};
  const Matrix excess = distances.rowwise() - tolerated.transpose();
  Index row = 0, state = 0;
  if (excess.maxCoeff(&row, &state) <= 0) return {};
  const std::string by = std::isfinite(distances(row, state)) ? fmt::format("by {:.2g}", distances(row, state))
                                                              : "from a prediction to none";
  return fmt::format("{} of {} rows, {} {}", (excess.rowwise().maxCoeff().array() > 0).count(), excess.rows(),
                     task.states[static_cast<std::size_t>(state)].name, by);
}

}  // namespace rehearse::robot_file
