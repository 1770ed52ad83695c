#pragma once

#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/study/options.hpp"
#include "rehearse/study/zeros.hpp"

namespace rehearse::study {

/// Control steps in a time, at least one.
Index steps_of(double time_s, const Task& task);

/// The states that `zeros` names. Throws InvalidInput if there is no such state, or if one is named twice.
std::vector<Index> states_named(const std::string& names, const Task& task);

/// The zeros and parameters that these options look for. The prior must outlive it.
ZeroProblem zero_problem(const prior::Prior& prior, const Task& task, const Options& options);

/// A model learned from logs.
struct LogModel {
  Zeros zeros;
  identification::Learned learned;  // of the states with their zeros moved
  Dataset data;                     // what it was learned from
  Index all_rows = 0;               // that the logs have
};

/// Zeros and φ over some steps first, and from there GP-MI (identification::learn) on stretches of a second at most,
/// evenly spread over the logs.
LogModel learn_logs(const std::vector<Episode>& logs, const Task& task, const prior::Prior& prior,
                    const Options& options, const Evaluator& evaluator);

/// The model of a LogModel's zeros and data with what these options learn beyond the parameters: around the prior at
/// the φ of the zeros, but for GP-MI, which moves it.
identification::Learned learned_beyond(const LogModel& model, const Task& task, const prior::Prior& prior,
                                       const Options& options, const Evaluator& evaluator);

/// A log that a model did not learn from, as the model means its states. Its zeros follow from its first `zero_s`.
struct PreparedLog {
  Episode log;
  Vector offset;      // dx
  Vector offset_std;  // dx, how sure it is
  Index first = 0;    // step from which on nothing of the log is used
};
PreparedLog prepare(const Episode& log, const LogModel& model, const Task& task, const prior::Prior& prior,
                    const Options& options, const Evaluator& evaluator);

/// True if some state changes less in a step than its spread: the robot moves. At rest, independent errors of
/// measurement change by √2 times their spread, and parameters fitted to them are meaningless (von Neumann 1941).
bool moves(const LogModel& model);

/// 95 % intervals of the continuous parameters; none if they are unknown, or if nothing moves: they would be of noise.
std::vector<Interval> intervals_of(const LogModel& model);

}  // namespace rehearse::study
