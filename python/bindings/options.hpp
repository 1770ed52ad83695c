#pragma once

#include <map>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"

namespace rehearse::python {

/// Names and texts of options.
using OptionTexts = std::map<std::string, std::string>;

/// Sets options by name. others: further arguments, which may have been meant. Throws InvalidInput with a line for each
/// that is unknown or outside its bound.
void set_options(const Fields& fields, const OptionTexts& texts, const std::vector<std::string>& others);

}  // namespace rehearse::python
