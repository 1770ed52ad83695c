#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/qd/kd_tree.hpp"
#include "rehearse/qd/nearest_table.hpp"

namespace rehearse::qd {

inline constexpr double kMostNiches = 1e8;  // an archive keeps 4 bytes of each, filled or not

/// Boxes of the same size: bins[d] of them along descriptor d. A descriptor outside its bounds counts as on them.
struct Grid {
  std::vector<Interval> bounds;  // D
  std::vector<Index> bins;       // D
};

/// A centroidal Voronoi tessellation (Vassiliades 2018, "Using centroidal Voronoi tessellations to scale up
/// MAP-Elites"): k-means of points uniform in the bounds, each descriptor in units of its width. A descriptor belongs
/// to the nearest centroid, wherever it is.
struct Cvt {
  std::vector<Interval> bounds;  // D
  Index niches = 10000;
  Index samples = 100000;  // ≥ niches; pyribs's default
  Index iterations = 10;   // of Lloyd's algorithm
  std::uint64_t seed = 1;
};

/// The niches of a space of descriptors. A value; const methods may run concurrently.
class Niches {
 public:
  /// Throws InvalidInput with every violation.
  explicit Niches(Grid grid);
  explicit Niches(const Cvt& cvt, const Evaluator& evaluator = serial_evaluator());
  /// With these centroids (D × n).
  Niches(std::vector<Interval> bounds, Matrix centroids);

  Index size() const { return size_; }
  Index dimensions() const { return static_cast<Index>(bounds_.size()); }
  const std::vector<Interval>& bounds() const { return bounds_; }

  /// The niche of a descriptor of D numbers; −1 if one is not finite. Does not allocate.
  Index find(const double* descriptor) const;

  /// The middle of a niche of a grid, or the centroid of one of a tessellation; in the descriptor's units.
  Vector centre(Index niche) const;

  /// Each descriptor from its bounds to [0, 1] (D → D).
  Vector to_unit(const ConstVectorView& descriptor) const;

  bool is_grid() const { return !bins_.empty(); }
  const std::vector<Index>& bins() const { return bins_; }  // of a grid
  const Matrix& centroids() const { return centroids_; }    // of a tessellation, D × size()

  bool operator==(const Niches& other) const;

 private:
  double unit_at(Index d, double value) const {  // a descriptor's number in widths of its bounds
    return (value - bounds_[static_cast<std::size_t>(d)].low) * per_unit_(d);
  }
  Index find_box(const double* unit) const;

  std::vector<Interval> bounds_;
  std::vector<Index> bins_;
  Matrix centroids_;
  Vector per_unit_;     // D, 1 / width
  KdTree tree_;         // of the centroids, from the bounds to [0, 1]
  NearestTable table_;  // of them, where it is worth it
  Index size_ = 0;
};

/// A line for everything that makes `bounds` unfit for descriptors.
std::vector<std::string> bounds_violations(const std::vector<Interval>& bounds);

}  // namespace rehearse::qd
