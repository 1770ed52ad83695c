#include "rehearse/learners/logs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/episode_fit.hpp"

namespace rehearse::learners {

void Logs::add(const std::vector<Episode>& logs, const Task& task) {
  for (const Episode& log : logs) require_fit(log, task);
  for (const Episode& log : logs) steps_ += log.steps();
  logs_.insert(logs_.end(), logs.begin(), logs.end());
  const double second = std::clamp(std::round(1 / task.dt_s), 1.0, static_cast<double>(kMost));
  rows_ = spread_rows(logs_, kMost, static_cast<Index>(second));
}

std::string Logs::note() const {
  if (rows_.size() == steps_) return {};
  return fmt::format(
      "the model learns from {} of the {} control steps of the logs, evenly spread: all would take it too long",
      rows_.size(), steps_);
}

}  // namespace rehearse::learners
