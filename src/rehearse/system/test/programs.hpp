#pragma once
// Programs for tests: of three states, one action and one parameter.

#include <string>
#include <vector>

#include "rehearse/core/parameters.hpp"
#include "rehearse/system/program.hpp"
#include "rehearse/system/test/harm.hpp"

namespace rehearse::system {

inline Program test_program(std::vector<std::string> command) {
  return {.command = std::move(command),
          .answer_s = 5,
          .states = {"a", "b", "c"},
          .actions = {"u"},
          .parameters = {"shift"},
          .dt_s = 0.1};
}

inline Program hostile_program(const std::string& encoding) { return test_program({HOSTILE_PROGRAM, encoding}); }

/// A robot that keeps its own state, in Python.
inline Program robot_program() { return test_program({"python3", std::string(TEST_DATA_DIR) + "/robot.py"}); }

inline ParameterSpace shift_of(double value) { return ParameterSpace({Parameter::fixed("shift", value)}); }

}  // namespace rehearse::system
