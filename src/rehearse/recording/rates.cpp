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
