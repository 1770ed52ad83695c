#pragma once

#include <map>
#include <string>

#include "rehearse/core/options.hpp"

namespace rehearse::python {

/// Names and texts of options.
using OptionTexts = std::map<std::string, std::string>;

/// Sets options by name. Throws InvalidInput with a line for each that is unknown or outside its bound.
void set_options(const Fields& fields, const OptionTexts& texts);

}  // namespace rehearse::python
