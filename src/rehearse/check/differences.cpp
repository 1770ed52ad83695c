#include "rehearse/check/differences.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/name_list.hpp"
#include "rehearse/core/row_text.hpp"

namespace rehearse::check {

Matrix apart(const Matrix& one, const Matrix& other) {
  return one.binaryExpr(other, [](double a, double b) {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b) ? 0 : kInf;
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

std::string without_prediction(const Task& task, const Matrix& X, const Matrix& U, const Matrix& predicted) {
  Index first = -1, count = 0;
  for (Index row = predicted.rows() - 1; row >= 0; --row)
    if (!predicted.row(row).allFinite()) first = row, ++count;
  if (first < 0) return {};
  return fmt::format("{} of {} rows have no prediction; the first: {}, {}", count, predicted.rows(),
                     row_text(task.states, X.row(first).transpose(), X.cols()),
                     row_text(task.actions, U.row(first).transpose(), U.cols()));
}

std::string worse_than_nothing(const Task& task, const Vector& errors, const Vector& as_next, const Vector& changes) {
  constexpr double kClearly = 1.5;  // noise of measurements is in both, and priors that are far off are mended
  constexpr std::size_t kMost = 4;
  if ((errors.array() > changes.array()).all() && (errors.array() > as_next.array()).all())
    return "its answers are nearer to the states that a step reaches than to their changes: it must give changes";
  std::vector<std::string> names;
  for (Index s = 0; s < errors.size(); ++s)
    if (errors(s) > kClearly * changes(s)) names.push_back(task.states[static_cast<std::size_t>(s)].name);
  if (names.empty()) return {};
  return fmt::format("it errs by more than a step changes {}: a sign, a unit, a delay, or what it lacks",
                     list_of(names, kMost));
}

}  // namespace rehearse::check
