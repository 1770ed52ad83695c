#pragma once
// Whole runs of a pretending learner on the line, and what is in their folders.

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "fake.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/files/table.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment::fake {

namespace fs = std::filesystem;

inline Spec line_spec(Index trials, const std::string& learner = "echo") {
  return {.scenario = "line", .learner = learner, .trials = trials, .seed = 3};
}

inline std::vector<std::string> lines_of(const fs::path& path) {
  std::istringstream text(files::read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Bytes of everything in a run folder that must not depend on how the run came about.
inline std::string results_of(const fs::path& folder) {
  std::string bytes;
  for (const std::string name : {"spec.toml", "trials.csv", "errors.csv", "identifiability.csv", "notes.csv",
                                 "memories.csv", "policy.json", "done"})
    bytes += name + "\n" + files::read_file(folder / name);
  for (const std::string name : {"trajectories/trial-001.csv", "predictions/trial-003.csv"})
    bytes += name + "\n" + files::read_file(folder / name);
  return bytes;
}

/// The cells of a column of a run's trials.csv.
inline std::vector<std::string> column_of(const fs::path& folder, const std::string& name) {
  const files::Table table = files::read_csv(files::read_file(folder / "trials.csv"));
  const auto place = static_cast<std::size_t>(table.column(name));
  std::vector<std::string> cells;
  for (const auto& row : table.rows) cells.push_back(row.at(place));
  return cells;
}

}  // namespace rehearse::experiment::fake
