#pragma once

#include "rehearse/check/try_out.hpp"

namespace rehearse::check {

/// A line for everything that a learner would stumble over; none: all is well.
std::vector<std::string> complaints(const Tried& tried);

/// True if something may be wrong that a learner takes all the same.
bool has_notes(const Tried& tried);

}  // namespace rehearse::check
