#pragma once

#include <algorithm>

namespace rehearse::optim {

/// The damping of steps to the optimum of a model that is trusted nearby alone (Levenberg 1944): more of it makes a
/// step shorter. It grows when a step is refused, or gains less than a quarter of what the model promised, and falls
/// when one gains more than three quarters (Fletcher 1971). Use it in a search that makes its own steps. Not for
/// several threads at once.
class Damping {
 public:
  explicit Damping(double least) : least_(least) {}

  double value() const { return value_; }

  /// The step was no gain: the next one is to be shorter.
  void refuse() { value_ = std::max(10 * value_, kFirst); }

  /// The step was made. gain > 0, promised > 0: in one unit.
  void judge(double gain, double promised) {
    if (gain > 0.75 * promised) value_ = std::max(value_ / 10, least_);
    if (gain < 0.25 * promised) value_ = std::max(4 * value_, kFirst);
  }

 private:
  static constexpr double kFirst = 1e-6;

  double least_, value_ = kFirst;
};

}  // namespace rehearse::optim
