#include "rehearse/qd/map_elites.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::qd {
namespace {

constexpr Index kChunk = 64;  // solutions evaluated together, whatever the number of threads

using Rows = Eigen::Map<Matrix>;

/// A chunk's part of a column of results: `rows` × `columns` from `at` on.
Rows part(double* column, Index at, Index rows, Index columns) { return {column + at * kChunk, rows, columns}; }

void check(const Archive& archive, const SearchSpace& space, const MapElitesOptions& options) {
  Violations violations;
  MapElitesOptions copy = options;
  violations.add(field_violations([&](FieldVisitor& v) { copy.fields(v); }));
  const Index P = archive.parameters();
  violations.require(space.box.empty() || static_cast<Index>(space.box.size()) == P,
                     fmt::format("the box has {} sides, must have {}", space.box.size(), P));
  for (const Interval& side : space.box)
    violations.require(std::isfinite(side.high - side.low) && side.low < side.high,
                       fmt::format("the box has a side [{}, {}], must be finite with low < high", side.low, side.high));
  violations.require(!space.start || (space.start->size() == P && space.start->allFinite()),
                     fmt::format("the start must have {} finite parameters", P));
  violations.require(space.examples.rows() == 0 || (space.examples.cols() == P && space.examples.allFinite()),
                     fmt::format("examples must have {} finite parameters", P));
  violations.require(space.examples.rows() == 0 || !space.box.empty(), "examples need a box");
  violations.require(space.start || !space.box.empty(), "there must be a box or a start");
  violations.require(options.variation.kind != Variation::Kind::reset || !space.box.empty(),
                     "variation.kind = reset needs a box");
  violations.throw_if_any();
}

}  // namespace

void MapElitesOptions::fields(FieldVisitor& v) {
  v.integer("batch", batch, "policies of a generation, made from the same archive", between(1, 1e6));
  v.integer("initial", initial, "policies drawn at random first", between(1, 1e7));
  v.number("examples", examples, "share of the first policies that is near an example, where there is one",
           between(0, 1));
  v.number("example_sigma", example_sigma, "standard deviation of these from the example, in widths of the bounds",
           at_least(0));
  v.group("variation", variation);
}

MapElites::MapElites(Archive archive, SearchSpace space, MapElitesOptions options, StreamKey key)
    : archive_(std::move(archive)),
      space_((check(archive_, space, options), std::move(space))),
      options_(options),
      varier_(options.variation, space_.box, archive_.parameters(), key) {}

void MapElites::resume(Archive archive, std::uint64_t evaluations, std::uint64_t failed) {
  if (archive.parameters() != archive_.parameters() || !(archive.niches() == archive_.niches()))
    throw InvalidInput("the archive to go on from is of another search: its niches or parameters differ");
  archive_ = std::move(archive);
  evaluations_ = evaluations;
  failed_ = failed;
  asked_.resize(0, 0);
}

void MapElites::make(std::uint64_t first, MatrixView X) const {
  const bool initial = evaluations_ < static_cast<std::uint64_t>(options_.initial) || archive_.size() == 0;
  if (!initial) return varier_.vary(archive_, first, X);
  if (space_.start) return varier_.draw_about(*space_.start, first, X);
  if (space_.examples.rows() == 0) return varier_.draw(first, X);
  varier_.draw_near(space_.examples, options_.examples, options_.example_sigma, first, X);
}

void MapElites::step(const Evaluate& evaluate, const Evaluator& evaluator) {
  const Index P = archive_.parameters(), D = archive_.niches().dimensions(), batch = options_.batch;
  const Index chunks = (batch + kChunk - 1) / kChunk;
  chunks_.resize(kChunk * (P + D + 2), chunks);
  const auto rows_of = [&](Index c) { return std::min(kChunk, batch - c * kChunk); };
  const auto task = [&](Index c) {
    double* column = chunks_.col(c).data();
    const Index rows = rows_of(c);
    const std::uint64_t first = evaluations_ + static_cast<std::uint64_t>(c * kChunk);
    Rows X = part(column, 0, rows, P), descriptors = part(column, P, rows, D);
    Rows performances = part(column, P + D, rows, 1), niches = part(column, P + D + 1, rows, 1);
    make(first, X);
    evaluate(X, first, performances.col(0), descriptors);
    double descriptor[KdTree::kMostDimensions];
    for (Index i = 0; i < rows; ++i) {
      for (Index d = 0; d < D; ++d) descriptor[d] = descriptors(i, d);
      niches(i) = static_cast<double>(archive_.niches().find(descriptor));
    }
  };
  evaluator.for_each(chunks, task);

  double descriptor[KdTree::kMostDimensions];
  for (Index c = 0; c < chunks; ++c) {
    double* column = chunks_.col(c).data();
    const Index rows = rows_of(c);
    const Rows X = part(column, 0, rows, P), descriptors = part(column, P, rows, D);
    const Rows performances = part(column, P + D, rows, 1), niches = part(column, P + D + 1, rows, 1);
    for (Index i = 0; i < rows; ++i) {
      for (Index d = 0; d < D; ++d) descriptor[d] = descriptors(i, d);
      keep(performances(i), descriptor, static_cast<Index>(niches(i)), X.data() + i, rows);
    }
  }
  evaluations_ += static_cast<std::uint64_t>(batch);
  asked_.resize(0, 0);
}

const Matrix& MapElites::ask() {
  if (asked_.rows() == 0) {
    asked_.resize(options_.batch, archive_.parameters());
    make(evaluations_, asked_);
  }
  return asked_;
}

void MapElites::tell(const ConstVectorView& performances, const ConstMatrixView& descriptors) {
  const Index batch = options_.batch, D = archive_.niches().dimensions();
  if (performances.size() != batch || descriptors.rows() != batch || descriptors.cols() != D)
    throw InvalidInput(fmt::format("told {} performances and {} × {} descriptors, must be {} and {} × {}",
                                   performances.size(), descriptors.rows(), descriptors.cols(), batch, batch, D));
  const Matrix& X = ask();
  for (Index i = 0; i < batch; ++i) {
    const Vector descriptor = descriptors.row(i).transpose();
    keep(performances(i), descriptor.data(), archive_.niches().find(descriptor.data()), X.data() + i, batch);
  }
  evaluations_ += static_cast<std::uint64_t>(batch);
  asked_.resize(0, 0);
}

void MapElites::keep(double performance, const double* descriptor, Index niche, const double* solution, Index stride) {
  if (niche < 0 || !std::isfinite(performance))
    ++failed_;
  else
    archive_.add(niche, performance, descriptor, solution, stride);
}

}  // namespace rehearse::qd
