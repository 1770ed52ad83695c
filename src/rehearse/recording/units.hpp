#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rehearse::recording {

/// Times what a number in one unit is one in the other: ("deg", "rad") → π/180. 1 where they are spelled alike ("N m",
/// "N·m", "Nm"); empty where it is not known how, or they measure different things.
std::optional<double> conversion(const std::string& from, const std::string& to);

/// This unit, and those that are converted to it: "rad/s", "deg/s", "°/s", "rpm".
std::vector<std::string> units_like(const std::string& unit);

}  // namespace rehearse::recording
