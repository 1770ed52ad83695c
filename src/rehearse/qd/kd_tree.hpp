#pragma once

#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::qd {

/// Finds the nearest of many points, exactly (Friedman 1977). Immutable; any thread; a search does not allocate.
class KdTree {
 public:
  static constexpr Index kMostDimensions = 64;

  KdTree() = default;

  /// points: D × n, one a column, finite; n ≥ 1, D in 1..kMostDimensions.
  explicit KdTree(const ConstMatrixView& points);

  Index size() const { return points_.cols(); }
  Index dimensions() const { return points_.rows(); }

  /// The column of the point nearest to `query` (D numbers, finite); of several the first.
  Index nearest(const double* query) const;

  /// Adds the columns of all points no farther than `radius`, in no order.
  void within(const double* query, double radius, std::vector<Index>& found) const;

 private:
  template <int D>
  struct Search;
  struct Plane {
    Index axis = 0;
    double at = 0;
  };

  void split(Index begin, Index end, const ConstMatrixView& points, std::vector<Index>& order);
  void within(Index begin, Index end, const double* query, double radius, std::vector<Index>& found) const;
  template <int D>
  Index nearest_of(const double* query) const;

  Matrix points_;                // D × n in the order of the leaves
  std::vector<Index> original_;  // n, the columns that they were
  std::vector<Plane> planes_;    // n, that part the points before this one from it and those after it
};

}  // namespace rehearse::qd
