#pragma once

#include <string>
#include <vector>

#include "rehearse/study/study.hpp"

namespace rehearse::study {

/// A part of what a study says: a table, whose first row is its head, and sentences; either may be empty.
struct Section {
  std::string title;
  std::vector<std::vector<std::string>> table;
  std::vector<std::string> notes;
};

std::vector<Section> summary(const Study& study, const Problem& problem);

/// For a terminal: the table's columns below one another, then the notes.
std::vector<std::string> lines_of(const Section& section);

}  // namespace rehearse::study
