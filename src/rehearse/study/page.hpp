#pragma once

#include <string>

#include "rehearse/study/study.hpp"

namespace rehearse::study {

/// A study as one page without scripts: the summary, parameters as bars between their bounds, and the forecasts of
/// every tested log with their bands.
std::string page(const Study& study, const Problem& problem, const std::string& robot);

}  // namespace rehearse::study
