#pragma once
// A catalogue with presets for the line.

#include <string>

#include "fake.hpp"
#include "rehearse/experiment/preset_check.hpp"

namespace rehearse::experiment::presets {

inline Catalogue with(const std::string& text) {
  Catalogue catalogue = fake::catalogue();
  catalogue.presets = {{"careful", "format = 1\n" + text}, {"bold", "format = 1\n[set]\nnoise = 2\n"}};
  return catalogue;
}

}  // namespace rehearse::experiment::presets
