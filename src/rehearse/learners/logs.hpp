#pragma once

#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/task.hpp"

namespace rehearse::learners {

/// Logs of other controllers, and the steps of them that a model learns from: all, or some `kMost` of them in evenly
/// spread stretches of a second. The time of GPs grows with the cube of their rows; a log of five minutes would take
/// days. One thread.
class Logs {
 public:
  static constexpr Index kMost = 400;

  void add(const std::vector<Episode>& logs, const Task& task);  // throws InvalidInput where one does not fit it
  const Dataset& rows() const { return rows_; }

  /// How many steps are learned from; empty: all are.
  std::string note() const;

 private:
  std::vector<Episode> logs_;
  Dataset rows_;
  Index steps_ = 0;
};

}  // namespace rehearse::learners
