#pragma once
// Common parts of the texts of an exported policy.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/policy/exported.hpp"

namespace rehearse::policy {

/// A number that reads back as the same double.
std::string number(double value);

/// "{1.0, 2.0}", of C, or "[1.0, 2.0]", of Python: in lines of at most 120 characters, all but the first indented.
struct Brackets {
  char open, close;
  std::string indent;
};
std::string numbers(const Vector& values, const Brackets& brackets);
std::string rows(const Matrix& values, const Brackets& brackets);

/// The text with each @WORD@ replaced. Every word must have a value.
std::string filled(std::string_view text, const std::map<std::string, std::string>& values);

/// Values of words that all texts have: MARK, STATES, ACTIONS, DT_S, STEPS.
std::map<std::string, std::string> common_values(const Exported& exported);

/// "angle [rad]", as a comment may have it: without what ends one, or a line.
std::string labelled(const std::string& name, const std::string& unit);

/// Lines of a comment on the policy's origin, inputs and outputs.
std::vector<std::string> explanation(const Exported& exported);

/// The number of states that are measured, and of those in the memory behind them.
Index measured(const Exported& exported);
Index memory(const Exported& exported);

/// Bounds of all actions, low or high.
Vector lows(const Exported& exported);
Vector highs(const Exported& exported);

/// Features of plain states are kept within ± this, where every policy is saturated: nothing overflows.
inline constexpr const char* kLargestInput = "1e100";

/// Times beyond this one [s] are no longer distinguished.
inline constexpr const char* kLargestTime = "1e12";

}  // namespace rehearse::policy
