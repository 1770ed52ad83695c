#pragma once
// A catalogue with presets for the line.

#include <string>
#include <utility>
#include <vector>

#include "fake.hpp"
#include "rehearse/experiment/preset_check.hpp"

namespace rehearse::experiment::presets {

using Options = std::vector<std::pair<std::string, std::string>>;

inline Catalogue with(const std::string& text) {
  Catalogue catalogue = fake::catalogue();
  catalogue.presets = {{"careful", "format = 1\n" + text}, {"bold", "format = 1\n[set]\nnoise = 2\n"}};
  return catalogue;
}

inline Spec spec_of(const std::string& learner, const Options& options = {}) {
  return {.scenario = "line", .learner = learner, .options = options};
}

}  // namespace rehearse::experiment::presets
