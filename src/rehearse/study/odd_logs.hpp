#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/study/bands.hpp"

namespace rehearse::study {

/// The fraction of a log's changes that forecasts leave unexplained: the errors' root mean square over that of the
/// changes, of all horizons and states the geometric mean. measured: T+1 × dx. NaN where nothing can be compared.
double unexplained(const Forecasts& forecasts, const Matrix& measured);

/// The log that is as if of another robot. unexplained: of each log, by a model that did not learn from it; NaN: not
/// known. A third at least, and three times that of any other. None of fewer than three logs, since one of two cannot
/// be told from the other.
std::optional<std::size_t> odd_log(const std::vector<double>& unexplained);

}  // namespace rehearse::study
