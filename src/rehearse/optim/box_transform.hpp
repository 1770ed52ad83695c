#pragma once
// Search without bounds over points that must stay in a box: a smooth map of the whole space onto the box that is the
// identity except near the bounds.

#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// Linear inside, quadratic within a margin of each bound, mirrored and periodic beyond (the boundary transformation of
/// Hansen's pycma). The margin is (1 + |bound|) / 20, at most half of the box.
class BoxTransform {
 public:
  BoxTransform() = default;                          // unbounded: the identity
  explicit BoxTransform(std::vector<Interval> box);  // finite, low < high

  bool bounded() const { return !box_.empty(); }
  const std::vector<Interval>& box() const { return box_; }

  /// Maps each column of X (dimension × count) into the box.
  void into(MatrixView X) const;

  /// Of all points that map to x (in the box), the one nearest to `near`, coordinate by coordinate.
  Vector preimage(const ConstVectorView& x, const ConstVectorView& near) const;

 private:
  std::vector<Interval> box_;
};

/// A line for everything that makes `box` unfit for points of n coordinates; an empty box is fit.
std::vector<std::string> box_violations(const std::vector<Interval>& box, Index n);

/// A line for everything that makes `start` unfit: empty, not finite, outside the box (if there is one).
std::vector<std::string> start_violations(const Vector& start, const std::vector<Interval>& box);

}  // namespace rehearse::optim
