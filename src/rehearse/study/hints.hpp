#pragma once
// Faults of logs that no parameter explains: encoders without a zero, and actions that act late or the other way.

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/study/options.hpp"
#include "rehearse/study/zeros.hpp"

namespace rehearse::study {

/// Another reading of the logs, with which the parameters would predict them much better.
struct Hint {
  std::vector<Index> states = {};  // whose zeros are off
  Index negated = -1;              // an action that has the other sign; −1: none
  double delay_s = 0;              // of the actions, added to what they have; negative: they act earlier
  double errors = 1;               // over the fit's horizon, of those that are left as the logs are read
};

/// "actions seem to act 0.06 s later than …", with the option of `identify` to try.
std::string line_of(const Hint& hint, const Task& task);

/// The better readings, the best first, found from the first four logs. The robot is without actuators
/// (study/robot_alone.hpp).
std::vector<Hint> find_hints(const std::vector<Episode>& logs, const Task& task, const prior::Prior& prior,
                             const Options& options, const Evaluator& evaluator);

}  // namespace rehearse::study
