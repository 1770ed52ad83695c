#include "rehearse/gp/inputs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::gp {
namespace {

/// Below this fraction of its magnitude, a column's variation is rounding; below the second number its inverse
/// overflows.
constexpr double kConstant = 1e-13, kSmallest = 1e-300;

void require_finite(const ConstMatrixView& X) {
  Violations wrong;
  wrong.require(X.rows() > 0, "gp inputs have 0 rows, must be ≥ 1");
  const auto bad = static_cast<Index>((!X.array().isFinite()).count());
  for (Index i = 0; i < X.rows() && bad > 0 && wrong.empty(); ++i)
    for (Index d = 0; d < X.cols() && wrong.empty(); ++d)
      if (!std::isfinite(X(i, d)))
        wrong.add(fmt::format("gp inputs({}, {}) = {}, must be finite{}", i, d, X(i, d),
                              bad > 1 ? fmt::format(", as must {} others", bad - 1) : ""));
  wrong.throw_if_any();
}

}  // namespace

double standard_deviation(const ConstVectorView& x) {
  if (x.size() < 2) return 0;
  return (x.array() - x.mean()).matrix().norm() / std::sqrt(static_cast<double>(x.size() - 1));
}

Inputs::Inputs(const ConstMatrixView& X) : unit_(X.rows(), X.cols()), center_(X.cols()), half_range_(X.cols()) {
  require_finite(X);
  spread_.resize(X.cols());
  for (Index d = 0; d < X.cols(); ++d) {
    const double low = X.col(d).minCoeff(), high = X.col(d).maxCoeff();
    center_(d) = low / 2 + high / 2;
    half_range_(d) = high / 2 - low / 2;
    const bool constant = half_range_(d) <= std::max(kConstant * std::abs(center_(d)), kSmallest);
    if (constant) half_range_(d) = std::max(std::abs(center_(d)), 1.0);
    unit_.col(d) = (X.col(d).array() - center_(d)) * (1 / half_range_(d));
    spread_(d) = constant ? half_range_(d) : standard_deviation(unit_.col(d)) * half_range_(d);
  }
}

}  // namespace rehearse::gp
