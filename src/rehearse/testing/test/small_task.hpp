#pragma once
// A task for what is made with a fault, and what the checks say of that as one text.

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"

namespace rehearse::testing {

inline Task small_task() {
  Task task;
  task.states = {{"x", ""}};
  task.actions = {{"u", "", {-1, 1}}};
  task.start_mean = task.start_std = Vector{{0}};
  task.dt_s = 0.1;
  task.horizon = 5;
  return task;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace rehearse::testing
