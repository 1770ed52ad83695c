#pragma once

#include <string>
#include <vector>

#include "rehearse/study/study.hpp"

namespace rehearse::study {

/// A part of what a study says in plain words.
struct Paragraph {
  std::string title;
  std::vector<std::string> lines;
};

std::vector<Paragraph> summary(const Study& study, const Problem& problem);

}  // namespace rehearse::study
