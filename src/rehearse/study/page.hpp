#pragma once

#include <string>

#include "rehearse/study/study.hpp"

namespace rehearse::study {

/// A study as one page without scripts: the summary, parameters as bars in their boxes, forecasts of the first tested
/// log with their bands, and errors by horizon.
std::string page(const Study& study, const Problem& problem, const std::string& robot);

}  // namespace rehearse::study
