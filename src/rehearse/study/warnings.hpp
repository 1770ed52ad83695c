#pragma once

#include <string>
#include <vector>

#include "rehearse/study/study.hpp"

namespace rehearse::study {

/// Sentences on parameters that the logs do not tell: that nothing moves; else intervals that do not overlap,
/// parameters that cannot be told apart, and those that would predict best at a bound. Empty: nothing is wrong.
std::vector<std::string> parameter_warnings(const Study& study, const Problem& problem);

/// Sentences on zeros, delays and signs of actions that would explain the logs better, and on a log that does not fit
/// the others.
std::vector<std::string> log_warnings(const Study& study, const Task& task);

}  // namespace rehearse::study
