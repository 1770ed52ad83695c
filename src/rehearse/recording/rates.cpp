#include "rehearse/recording/rates.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace rehearse::recording {
namespace {

/// Sums of n neighbours each; what is left at the end is left out.
Vector sums_of(const Vector& values, Index n) {
  return values.head(values.size() / n * n).reshaped(n, values.size() / n).colwise().sum().transpose();
}

/// The mean square of changes from one number to the next, which is what noise makes large and motion small.
double roughness(const Vector& values) {
  const Index n = values.size() - 1;
  return n < 1 ? INFINITY : (values.tail(n) - values.head(n)).squaredNorm() / static_cast<double>(n);
}

/// A state's changes and those that its rate says, over parts of an episode that are so long that noise matters little.
struct Parts {
  Vector expected, changes;
  bool expected_moves, state_moves;  // by much more than noise makes of states at rest

  Parts(const Vector& all_expected, const Vector& all_changes) {
    constexpr Index kParts = 25;
    constexpr double kClear = 10;  // times the mean square that noise makes
    const Index length = std::max<Index>(1, all_changes.size() / kParts);
    expected = sums_of(all_expected, length), changes = sums_of(all_changes, length);
    const auto moves = [&](const Vector& sums, double noise) {
      return sums.squaredNorm() > kClear * noise * static_cast<double>(sums.size());
    };
    // Noise of states cancels in sums of changes but at both ends, that of rates adds up.
    expected_moves = moves(expected, 2 * roughness(all_expected) * static_cast<double>(length));
    state_moves = moves(changes, roughness(all_changes) / 3);
  }
};

/// How many of the changes, one after the other, are 0 while the rate says clearly more than usual ones; 0: none.
Index stands_still(const Vector& expected, const Vector& changes) {
  constexpr Index kFewest = 10;
  constexpr double kClear = 2;  // of the largest change: a slow sensor catches up
  const double clear = kClear * changes.cwiseAbs().maxCoeff();
  Index longest = 0, length = 0;
  double expected_since = 0;
  for (Index i = 0; i < changes.size(); ++i) {
    length = changes(i) == 0 ? length + 1 : 0;
    expected_since = changes(i) == 0 ? expected_since + expected(i) : 0;
    if (length >= kFewest && std::abs(expected_since) > clear) longest = std::max(longest, length);
  }
  return longest;
}

/// A column that is no measurement, or another one, which shows in no factor.
std::string note_on_unrelated(const std::string& state, const std::string& rate, const Vector& expected,
                              const Vector& changes) {
  constexpr double kUnrelated = 0.25;
  const Parts parts(expected, changes);
  if (changes.isZero(0))
    return parts.expected_moves ? fmt::format("{} is the same in all rows, while {} says that it changes", state, rate)
                                : "";
  if (expected.isZero(0))
    return parts.state_moves ? fmt::format("{} is 0 in all rows, while {} changes", rate, state) : "";
  if (const Index still = stands_still(expected, changes); still > 0)
    return fmt::format("{} stands still for {} steps, while {} says that it changes: is its sensor disturbed?", state,
                       still, rate);
  const double both = parts.expected.dot(parts.changes);
  const double explained = both * both / (parts.expected.squaredNorm() * parts.changes.squaredNorm());
  if (!parts.expected_moves || !parts.state_moves || explained > kUnrelated) return "";
  return fmt::format("{} does not change as {} says, by no factor: is one of the columns another quantity?", state,
                     rate);
}

}  // namespace

std::string note_on_rate(const std::string& state, const std::string& rate, const Vector& expected,
                         const Vector& changes) {
  constexpr double kRounding = 1e-12;  // of a way in any unit: nothing moves
  if (expected.lpNorm<1>() < kRounding && changes.lpNorm<1>() < kRounding) return "";
  if (std::string note = note_on_unrelated(state, rate, expected, changes); !note.empty()) return note;
  const double xx = expected.squaredNorm(), xy = expected.dot(changes), yy = changes.squaredNorm();
  const double explained = xy * xy / (xx * yy);                                    // NaN where one never changes
  const Interval usual = explained > 0.9 ? Interval{0.7, 1.4} : Interval{0.5, 2};  // noisy rates look too fast
  if (!(explained > 0.5) || (xy > usual.low * xx && xy < usual.high * xx)) return "";
  return fmt::format(
      "{} changes {:.3g} times as fast as {} says: is one in another unit, of another scale, or of another sign?",
      state, xy / xx, rate);
}

double lateness_s(const Vector& times_s, const Vector& state, const Vector& rate) {
  constexpr Index kMostHalves = 4, kFewest = 20;
  constexpr double kTwice = 0.25, kSeen = 1e-4;  // of squares
  const Index n = state.size() - 1 - kMostHalves / 2;
  if (n < kFewest) return 0;
  const Vector dt = times_s.segment(1, n) - times_s.head(n), changes = state.segment(1, n) - state.head(n);
  Index late = 0;
  double least = 0, in_time = 0;
  for (Index halves = 0; halves <= kMostHalves; ++halves) {
    const Index before = (halves + 1) / 2,
                after = halves / 2 + 1;  // rows between which a row's middle is so much later
    const Vector expected = 0.5 * dt.cwiseProduct(rate.segment(before, n) + rate.segment(after, n));
    const double left = (changes - expected).squaredNorm();
    if (halves == 0) least = in_time = left;
    if (left < least) least = left, late = halves;
  }
  const bool seen = in_time > kSeen * changes.squaredNorm() && least < kTwice * in_time;
  return seen ? 0.5 * static_cast<double>(late) * dt.mean() : 0;
}

std::vector<std::string> notes_on_rates(const Task& task, const ConstMatrixView& X, const ConstMatrixView& X_next) {
  std::vector<std::string> notes;
  for (const Kinematics::Pair& pair : task.kinematics().pairs) {
    const Vector expected = 0.5 * task.dt_s * (X.col(pair.rate) + X_next.col(pair.rate));
    const Vector changes = X_next.col(pair.position) - X.col(pair.position);
    const auto name = [&](Index state) { return task.states[static_cast<std::size_t>(state)].name; };
    if (std::string note = note_on_rate(name(pair.position), name(pair.rate), expected, changes); !note.empty())
      notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace rehearse::recording
