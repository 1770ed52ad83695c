#include "rehearse/qd/nearest_table.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::qd {
namespace {

constexpr double kBoxesPerPoint = 4;
// More candidates are those of points that coincide, or lie far from all boxes.
constexpr std::size_t kCandidatesPerBox = 64, kFewCandidates = 1 << 22;

}  // namespace

// The nearest point of any place in a box is no farther from the box's middle than the middle's own nearest point and
// the diagonal.
NearestTable::NearestTable(const KdTree& tree, Matrix points) : points_(std::move(points)) {
  const auto D = static_cast<double>(points_.rows());
  const auto wanted = kBoxesPerPoint * static_cast<double>(points_.cols());
  boxes_per_axis_ = static_cast<Index>(std::ceil(std::pow(wanted, 1 / D)));
  const double width = 1 / static_cast<double>(boxes_per_axis_), diagonal = width * std::sqrt(D);
  const auto boxes = static_cast<Index>(std::llround(std::pow(static_cast<double>(boxes_per_axis_), D)));
  Vector middle(points_.rows());
  std::vector<Index> near;
  begins_.push_back(0);
  for (Index box = 0; box < boxes; ++box) {
    Index rest = box;
    for (Index d = points_.rows() - 1; d >= 0; --d, rest /= boxes_per_axis_)
      middle(d) = (static_cast<double>(rest % boxes_per_axis_) + 0.5) * width;
    const double least = (points_.col(tree.nearest(middle.data())) - middle).norm();
    near.clear();
    tree.within(middle.data(), (least + diagonal) * (1 + 1e-9), near);
    std::sort(near.begin(), near.end());
    candidates_.insert(candidates_.end(), near.begin(), near.end());
    begins_.push_back(static_cast<std::uint32_t>(candidates_.size()));
    if (candidates_.size() <= std::max(kFewCandidates, kCandidatesPerBox * static_cast<std::size_t>(boxes))) continue;
    *this = {};
    return;
  }
}

Index NearestTable::nearest(const double* query) const {
  const Index box = box_of(query), D = points_.rows();
  if (box < 0) return -1;
  double best = kInf;
  Index found = -1;
  for (std::uint32_t c = begins_[static_cast<std::size_t>(box)]; c < begins_[static_cast<std::size_t>(box) + 1]; ++c) {
    const double* point = points_.data() + candidates_[c] * D;
    double distance = 0;
    for (Index d = 0; d < D; ++d) distance += (query[d] - point[d]) * (query[d] - point[d]);
    if (distance >= best) continue;
    best = distance;
    found = candidates_[c];
  }
  return found;
}

/// −1: outside.
Index NearestTable::box_of(const double* query) const {
  Index box = 0;
  for (Index d = 0; d < points_.rows(); ++d) {
    if (!(query[d] >= 0 && query[d] < 1)) return -1;
    const auto at = static_cast<Index>(query[d] * static_cast<double>(boxes_per_axis_));
    box = box * boxes_per_axis_ + std::min(at, boxes_per_axis_ - 1);
  }
  return box;
}

}  // namespace rehearse::qd
