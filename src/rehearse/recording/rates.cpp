#include "rehearse/recording/rates.hpp"

#include <fmt/format.h>

namespace rehearse::recording {

std::string note_on_rate(const std::string& state, const std::string& rate, const Vector& expected,
                         const Vector& changes) {
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
