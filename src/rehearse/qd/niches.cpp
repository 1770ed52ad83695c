#include "rehearse/qd/niches.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"

namespace rehearse::qd {
namespace {

constexpr Index kChunk = 1024;  // samples

Index chunks_of(Index n) { return (n + kChunk - 1) / kChunk; }

/// D × samples, in [0, 1).
Matrix uniform_points(Index D, Index samples, std::uint64_t seed, std::uint64_t particle) {
  Matrix points(D, samples);
  for (Index i = 0; i < samples; ++i) {
    Rng rng({.seed = seed,
             .purpose = Purpose::tessellation,
             .candidate = static_cast<std::uint64_t>(i),
             .particle = particle});
    for (Index d = 0; d < D; ++d) points(d, i) = rng.uniform();
  }
  return points;
}

/// The centroid nearest to each sample.
void assign(const Matrix& centroids, const Matrix& samples, const Evaluator& evaluator, std::vector<Index>& nearest) {
  const KdTree tree(centroids);
  evaluator.for_each(chunks_of(samples.cols()), [&](Index c) {
    const Index last = std::min(samples.cols(), (c + 1) * kChunk);
    for (Index i = c * kChunk; i < last; ++i)
      nearest[static_cast<std::size_t>(i)] = tree.nearest(samples.col(i).data());
  });
}

/// Moves each centroid to the mean of its samples; one without samples stays.
void move(Matrix& centroids, const Matrix& samples, const std::vector<Index>& nearest) {
  Matrix sums = Matrix::Zero(centroids.rows(), centroids.cols());
  Vector counts = Vector::Zero(centroids.cols());
  for (Index i = 0; i < samples.cols(); ++i) {
    sums.col(nearest[static_cast<std::size_t>(i)]) += samples.col(i);
    counts(nearest[static_cast<std::size_t>(i)]) += 1;
  }
  for (Index c = 0; c < centroids.cols(); ++c)
    if (counts(c) > 0) centroids.col(c) = sums.col(c) / counts(c);
}

/// k-means in the unit cube, from random points. The same for any number of threads.
Matrix unit_centroids(const Cvt& cvt, const Evaluator& evaluator) {
  const auto D = static_cast<Index>(cvt.bounds.size());
  Matrix centroids = uniform_points(D, cvt.niches, cvt.seed, 0);
  const Matrix samples = uniform_points(D, cvt.samples, cvt.seed, 1);
  std::vector<Index> nearest(static_cast<std::size_t>(cvt.samples));
  for (Index i = 0; i < cvt.iterations; ++i) {
    assign(centroids, samples, evaluator, nearest);
    move(centroids, samples, nearest);
  }
  return centroids;
}

void check(const Cvt& cvt) {
  Violations violations;
  violations.add(bounds_violations(cvt.bounds));
  violations.require(cvt.niches >= 1 && static_cast<double>(cvt.niches) <= kMostNiches,
                     fmt::format("niches = {}, must be in [1, {:g}]", cvt.niches, kMostNiches));
  violations.require(cvt.samples >= cvt.niches,
                     fmt::format("samples = {}, must be ≥ niches = {}", cvt.samples, cvt.niches));
  violations.require(cvt.iterations >= 0, fmt::format("iterations = {}, must be ≥ 0", cvt.iterations));
  violations.throw_if_any();
}

Matrix made_centroids(const Cvt& cvt, const Evaluator& evaluator) {
  check(cvt);
  Matrix centroids = unit_centroids(cvt, evaluator);
  for (Index d = 0; d < centroids.rows(); ++d) {
    const Interval& bound = cvt.bounds[static_cast<std::size_t>(d)];
    centroids.row(d).array() = bound.low + (bound.high - bound.low) * centroids.row(d).array();
  }
  return centroids;
}

Vector inverse_widths(const std::vector<Interval>& bounds) {
  Vector inverse(bounds.size());
  for (std::size_t d = 0; d < bounds.size(); ++d) inverse(static_cast<Index>(d)) = 1 / (bounds[d].high - bounds[d].low);
  return inverse;
}

}  // namespace

std::vector<std::string> bounds_violations(const std::vector<Interval>& bounds) {
  Violations found;
  found.require(!bounds.empty() && static_cast<Index>(bounds.size()) <= KdTree::kMostDimensions,
                fmt::format("{} descriptors, must be 1 to {}", bounds.size(), KdTree::kMostDimensions));
  for (std::size_t d = 0; d < bounds.size(); ++d)
    found.require(std::isfinite(bounds[d].high - bounds[d].low) && bounds[d].low < bounds[d].high,
                  fmt::format("descriptor {}: bounds [{}, {}], must be finite with low < high", d + 1, bounds[d].low,
                              bounds[d].high));
  return found.list();
}

Niches::Niches(Grid grid) : bounds_(std::move(grid.bounds)), bins_(std::move(grid.bins)) {
  Violations violations;
  violations.add(bounds_violations(bounds_));
  violations.require(bins_.size() == bounds_.size(),
                     fmt::format("bins of {} descriptors, must be of {}", bins_.size(), bounds_.size()));
  double size = 1;
  for (std::size_t d = 0; d < bins_.size(); ++d) {
    violations.require(bins_[d] >= 1, fmt::format("descriptor {}: {} bins, must be ≥ 1", d + 1, bins_[d]));
    size *= static_cast<double>(bins_[d]);
  }
  violations.require(size <= kMostNiches, fmt::format("the grid has {:g} niches, must be ≤ {:g}", size, kMostNiches));
  violations.throw_if_any();
  per_unit_ = inverse_widths(bounds_);
  size_ = static_cast<Index>(size);
}

Niches::Niches(const Cvt& cvt, const Evaluator& evaluator) : Niches(cvt.bounds, made_centroids(cvt, evaluator)) {}

Niches::Niches(std::vector<Interval> bounds, Matrix centroids)
    : bounds_(std::move(bounds)), centroids_(std::move(centroids)), size_(centroids_.cols()) {
  Violations violations;
  violations.add(bounds_violations(bounds_));
  violations.require(centroids_.rows() == dimensions() && size_ >= 1 && centroids_.allFinite(),
                     fmt::format("{} centroids of {} descriptors, must be ≥ 1 of {} finite ones", size_,
                                 centroids_.rows(), dimensions()));
  violations.throw_if_any();
  per_unit_ = inverse_widths(bounds_);
  Matrix unit(dimensions(), size_);
  for (Index niche = 0; niche < size_; ++niche) unit.col(niche) = to_unit(centroids_.col(niche));
  tree_ = KdTree(unit);
  if (NearestTable::worthwhile(dimensions(), size_)) table_ = NearestTable(tree_, std::move(unit));
}

Index Niches::find(const double* descriptor) const {
  double unit[KdTree::kMostDimensions];
  for (Index d = 0; d < dimensions(); ++d) {
    if (!std::isfinite(descriptor[d])) return -1;
    unit[d] = unit_at(d, descriptor[d]);
  }
  if (is_grid()) return find_box(unit);
  const Index found = table_.empty() ? -1 : table_.nearest(unit);
  return found >= 0 ? found : tree_.nearest(unit);
}

Index Niches::find_box(const double* unit) const {
  Index niche = 0;
  for (Index d = 0; d < dimensions(); ++d) {
    const auto bins = static_cast<double>(bins_[static_cast<std::size_t>(d)]);
    niche = niche * bins_[static_cast<std::size_t>(d)] +
            static_cast<Index>(std::clamp(std::floor(unit[d] * bins), 0.0, bins - 1));
  }
  return niche;
}

Vector Niches::centre(Index niche) const {
  if (!is_grid()) return centroids_.col(niche);
  Vector centre(dimensions());
  for (Index d = dimensions() - 1; d >= 0; --d) {
    const Index bins = bins_[static_cast<std::size_t>(d)];
    const Interval& bound = bounds_[static_cast<std::size_t>(d)];
    const double part = (static_cast<double>(niche % bins) + 0.5) / static_cast<double>(bins);
    centre(d) = bound.low + part * (bound.high - bound.low);
    niche /= bins;
  }
  return centre;
}

Vector Niches::to_unit(const ConstVectorView& descriptor) const {
  Vector unit(dimensions());
  for (Index d = 0; d < dimensions(); ++d) unit(d) = unit_at(d, descriptor(d));
  return unit;
}

bool Niches::operator==(const Niches& other) const {
  const auto same = [](const Interval& a, const Interval& b) { return a.low == b.low && a.high == b.high; };
  return std::equal(bounds_.begin(), bounds_.end(), other.bounds_.begin(), other.bounds_.end(), same) &&
         bins_ == other.bins_ && centroids_.cols() == other.centroids_.cols() && centroids_ == other.centroids_;
}

}  // namespace rehearse::qd
