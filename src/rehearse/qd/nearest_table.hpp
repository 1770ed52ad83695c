#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/qd/kd_tree.hpp"

namespace rehearse::qd {

/// Finds the nearest of points as KdTree does, in the unit cube of few dimensions: the cube is cut into small boxes,
/// and of each the points are listed that are the nearest to some place in it. Immutable; any thread; no allocation.
class NearestTable {
 public:
  /// True if a table of so many points is smaller and faster than the tree alone.
  static bool worthwhile(Index dimensions, Index points) { return dimensions <= 3 && points >= 64 && points <= 200000; }

  NearestTable() = default;
  /// points: D × n, in any place; tree: theirs.
  NearestTable(const KdTree& tree, Matrix points);

  bool empty() const { return points_.cols() == 0; }

  /// The column of the point nearest to `query` (D numbers), of several the first; −1 outside the unit cube.
  Index nearest(const double* query) const;

 private:
  Index box_of(const double* query) const;

  Matrix points_;
  Index boxes_per_axis_ = 0;
  std::vector<std::uint32_t> begins_;      // of each box in candidates_; one more
  std::vector<std::uint32_t> candidates_;  // in ascending order
};

}  // namespace rehearse::qd
