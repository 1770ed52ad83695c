#pragma once
// Whether states change as their rates say.

#include <string>
#include <vector>

#include "rehearse/core/task.hpp"

namespace rehearse::recording {

/// A sentence if a state does not change as its rate says: a wrong unit, scale or sign, a sensor that stands still, or
/// a column of something else; else empty. expected: changes by the rate. Where these explain the changes well, they
/// may differ by less than those of a noisy rate.
std::string note_on_rate(const std::string& state, const std::string& rate, const Vector& expected,
                         const Vector& changes);

/// How late a rate is [s]: by half a row or more, two at most, if the state's changes are so explained at least twice
/// as well as by the rate in time, as differences of encoder readings are; else 0. All of the same rows (n).
double lateness_s(const Vector& times_s, const Vector& state, const Vector& rate);

/// Use it for an episode: these sentences on all states with a rate. X, X_next: a row a step, T × dx.
std::vector<std::string> notes_on_rates(const Task& task, const ConstMatrixView& X, const ConstMatrixView& X_next);

}  // namespace rehearse::recording
