#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rehearse::system {

/// A program in any language that simulates, or that is a robot. It reads messages from its standard input and answers
/// on its standard output; docs/programs.md has them all.
struct Program {
  std::vector<std::string> command;                      // the program and its arguments; no shell
  std::filesystem::path folder;                          // where it runs; empty: here
  double start_s = 30;                                   // until it answers the first message
  double answer_s = 10;                                  // until it answers any other
  std::vector<std::string> states, actions, parameters;  // their names
  double dt_s = 0;                                       // of a control step
};

}  // namespace rehearse::system
