#pragma once
// The recursion of commands (core/actuators.hpp), as lines of a program. For the sources of this room.

#include <functional>
#include <string>

#include "rehearse/core/actuators.hpp"

namespace rehearse::policy {

/// The words and signs of a programming language for the lines of `command_lines`.
struct Dialect {
  std::function<std::string(Index action)> action;
  std::function<std::string(Index state)> before;  // of the memory, before the step
  std::function<std::string(Index state)> after;   // and after it; may be the same place
  std::string limited;                             // "min(max({0}, {1}), {2})"
  std::string end;                                 // of a statement: ";"
  std::string indent;
};

/// Statements that make commands of actions, and then remember them.
std::string command_lines(const Actuators& actuators, const Dialect& dialect);

}  // namespace rehearse::policy
