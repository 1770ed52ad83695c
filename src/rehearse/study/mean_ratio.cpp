#include "rehearse/study/mean_ratio.hpp"

#include <cmath>

namespace rehearse::study {

double mean_ratio(const ConstMatrixView& errors, const ConstMatrixView& of) {
  constexpr double kFailed = 10;
  double sum = 0, n = 0;
  for (Index j = 0; j < of.cols(); ++j)
    for (Index i = 0; i < of.rows(); ++i) {
      if (!std::isfinite(of(i, j)) || of(i, j) <= 0 || errors(i, j) <= 0) continue;
      sum += std::isfinite(errors(i, j)) ? std::log(errors(i, j) / of(i, j)) : kFailed;
      n += 1;
    }
  return std::exp(sum / n);
}

}  // namespace rehearse::study
