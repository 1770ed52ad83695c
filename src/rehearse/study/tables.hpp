#pragma once
// A study as the text of CSV files. Numbers read back exactly; what does not apply is empty.

#include <string>
#include <utility>
#include <vector>

#include "rehearse/study/study.hpp"

namespace rehearse::study {

/// Name and text of each file.
std::vector<std::pair<std::string, std::string>> csv_files(const Study& study, const Problem& problem);

}  // namespace rehearse::study
