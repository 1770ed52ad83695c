#include "rehearse/qd/kd_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rehearse::qd {
namespace {

constexpr Index kLeaf = 10;  // points

Index middle(Index begin, Index end) { return begin + (end - begin) / 2; }

/// The axis along which these points extend most.
Index widest(Index begin, Index end, const ConstMatrixView& points, const std::vector<Index>& order) {
  Index axis = 0;
  double width = -1;
  for (Index d = 0; d < points.rows(); ++d) {
    double low = kInf, high = -low;
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

/// The search for one query; D is the number of dimensions, or Eigen::Dynamic.
template <int D>
struct KdTree::Search {
  const KdTree& tree;
  const double* query;
  double best = kInf;  // squared distance
  Index found = std::numeric_limits<Index>::max();
  double offsets[D > 0 ? D : kMostDimensions];  // of the query from the cell that is visited, along each axis

  Search(const KdTree& of, const double* from) : tree(of), query(from) { std::fill_n(offsets, dimensions(), 0.0); }

  Index dimensions() const { return D > 0 ? D : tree.dimensions(); }

  // The distance to a cell is kept up to date axis by axis (Arya 1993).
  void visit(Index begin, Index end, double cell_distance) {
    if (end - begin <= kLeaf) return scan(begin, end);
    const Index mid = middle(begin, end);
    const auto [axis, at] = tree.planes_[static_cast<std::size_t>(mid)];
    const double offset = query[axis] - at;
    const bool left = offset < 0;
    visit(left ? begin : mid, left ? mid : end, cell_distance);
    const double old = offsets[axis], other = cell_distance - old * old + offset * offset;
    if (other > best * (1 + 1e-12)) return;  // rounding must not hide an equal distance
    offsets[axis] = offset;
    visit(left ? mid : begin, left ? end : mid, other);
    offsets[axis] = old;
  }

  void scan(Index begin, Index end) {
    const double* point = tree.points_.data() + begin * dimensions();
    for (Index i = begin; i < end; ++i, point += dimensions()) {
      double distance = 0;
      for (Index d = 0; d < dimensions(); ++d) distance += (query[d] - point[d]) * (query[d] - point[d]);
      if (distance > best) continue;
      const Index index = tree.original_[static_cast<std::size_t>(i)];
      if (distance == best && index > found) continue;
      best = distance;
      found = index;
    }
  }
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

template <int D>
Index KdTree::nearest_of(const double* query) const {
  Search<D> search(*this, query);
  search.visit(0, size(), 0);
  return search.found;
}

Index KdTree::nearest(const double* query) const {
  switch (dimensions()) {  // those worth loops of a known length
    case 1:
      return nearest_of<1>(query);
    case 2:
      return nearest_of<2>(query);
    case 3:
      return nearest_of<3>(query);
    case 6:
      return nearest_of<6>(query);
    default:
      return nearest_of<Eigen::Dynamic>(query);
  }
}

void KdTree::within(const double* query, double radius, std::vector<Index>& found) const {
  within(0, size(), query, radius, found);
}

void KdTree::within(Index begin, Index end, const double* query, double radius, std::vector<Index>& found) const {
  if (end - begin > kLeaf) {
    const Index mid = middle(begin, end);
    const auto [axis, at] = planes_[static_cast<std::size_t>(mid)];
    if (query[axis] - radius <= at) within(begin, mid, query, radius, found);
    if (query[axis] + radius >= at) within(mid, end, query, radius, found);
    return;
  }
  const auto here = Vector::Map(query, dimensions());
  for (Index i = begin; i < end; ++i)
    if ((points_.col(i) - here).norm() <= radius) found.push_back(original_[static_cast<std::size_t>(i)]);
}

}  // namespace rehearse::qd
