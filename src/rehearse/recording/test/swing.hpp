#pragma once

#include <cmath>
#include <string>

#include "rehearse/core/task.hpp"
#include "rehearse/files/csv.hpp"

namespace rehearse::recording {

/// A pendulum: dq, q (an angle), torque; 0.05 s a step.
inline Task swing_task() {
  Task task;
  task.states = {{"dq", "rad/s"}, {"q", "rad", StateKind::angle, "dq"}};
  task.actions = {{"torque", "N m", {-2, 2}}};
  task.start_mean = task.start_std = Vector::Zero(2);
  task.dt_s = 0.05;
  task.horizon = 20;
  return task;
}

/// Rows of a swing, every `dt_s`.
inline std::string swing_csv(Index rows = 41, double dt_s = 0.05,
                             const std::string& header = "time [s],dq [rad/s],q [rad],torque [N m]") {
  std::string text = header + "\n";
  for (Index k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) * dt_s;
    for (const double value : {t, 3 * std::cos(3 * t), std::sin(3 * t)}) text += files::Csv::cell(value) + ",";
    text += files::Csv::cell(std::cos(t)) + "\n";
  }
  return text;
}

/// The row of this number (the header is 1) with the cell in the place of one.
inline std::string with_cell(const std::string& text, int row, int column, const std::string& cell) {
  std::size_t begin = 0;
  for (int i = 1; i < row; ++i) begin = text.find('\n', begin) + 1;
  for (int i = 1; i < column; ++i) begin = text.find(',', begin) + 1;
  const std::size_t end = text.find_first_of(",\n", begin);
  return text.substr(0, begin) + cell + text.substr(end);
}

}  // namespace rehearse::recording
