#include "rehearse/qd/kd_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rehearse::qd {
namespace {

constexpr Index kLeaf = 6;  // points

Index middle(Index begin, Index end) { return begin + (end - begin) / 2; }

/// The axis along which these points extend most.
Index widest(Index begin, Index end, const ConstMatrixView& points, const std::vector<Index>& order) {
  Index axis = 0;
  double width = -1;
  for (Index d = 0; d < points.rows(); ++d) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (Index i = begin; i < end; ++i) {
      const double x = points(d, order[static_cast<std::size_t>(i)]);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (high - low > width) {
      width = high - low;
      axis = d;
    }
  }
  return axis;
}

}  // namespace

struct KdTree::Search {
  const double* query;
  double best = std::numeric_limits<double>::infinity();  // squared distance
  Index found = std::numeric_limits<Index>::max();
  double offsets[kMostDimensions] = {};  // of the query from the cell that is visited, along each axis
};

KdTree::KdTree(const ConstMatrixView& points)
    : points_(points.rows(), points.cols()), planes_(static_cast<std::size_t>(points.cols())) {
  original_.resize(static_cast<std::size_t>(points.cols()));
  std::iota(original_.begin(), original_.end(), Index{0});
  split(0, points.cols(), points, original_);
  for (Index i = 0; i < points.cols(); ++i) points_.col(i) = points.col(original_[static_cast<std::size_t>(i)]);
}

void KdTree::split(Index begin, Index end, const ConstMatrixView& points, std::vector<Index>& order) {
  if (end - begin <= kLeaf) return;
  const Index axis = widest(begin, end, points, order), mid = middle(begin, end);
  const auto before = [&](Index a, Index b) {
    return points(axis, a) != points(axis, b) ? points(axis, a) < points(axis, b) : a < b;
  };
  std::nth_element(order.begin() + begin, order.begin() + mid, order.begin() + end, before);
  planes_[static_cast<std::size_t>(mid)] = {axis, points(axis, order[static_cast<std::size_t>(mid)])};
  split(begin, mid, points, order);
  split(mid, end, points, order);
}

Index KdTree::nearest(const double* query) const {
  Search search{.query = query};
  visit(0, size(), 0, search);
  return search.found;
}

// The distance to a cell is kept up to date axis by axis (Arya 1993).
void KdTree::visit(Index begin, Index end, double cell_distance, Search& search) const {
  if (end - begin <= kLeaf) return scan(begin, end, search);
  const Index mid = middle(begin, end);
  const auto [axis, at] = planes_[static_cast<std::size_t>(mid)];
  const double offset = search.query[axis] - at;
  const bool left = offset < 0;
  visit(left ? begin : mid, left ? mid : end, cell_distance, search);
  const double old = search.offsets[axis], other = cell_distance - old * old + offset * offset;
  if (other > search.best * (1 + 1e-12)) return;  // rounding must not hide an equal distance
  search.offsets[axis] = offset;
  visit(left ? mid : begin, left ? end : mid, other, search);
  search.offsets[axis] = old;
}

void KdTree::scan(Index begin, Index end, Search& search) const {
  const Index D = dimensions();
  const double* point = points_.data() + begin * D;
  for (Index i = begin; i < end; ++i, point += D) {
    double distance = 0;
    for (Index d = 0; d < D; ++d) {
      const double offset = search.query[d] - point[d];
      distance += offset * offset;
    }
    const Index index = original_[static_cast<std::size_t>(i)];
    if (distance < search.best || (distance == search.best && index < search.found)) {
      search.best = distance;
      search.found = index;
    }
  }
}

}  // namespace rehearse::qd
