#include "rehearse/qd/variation.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::qd {
namespace {

constexpr double kFinestLattice = 1e-9;

}  // namespace

void Variation::fields(FieldVisitor& v) {
  v.choice("kind", kind,
           "mutation: isotropic plus along the line to another elite, isotropic Gaussian, or random reset",
           {"iso_line", "gaussian", "reset"});
  v.number("iso_sigma", iso_sigma, "standard deviation of the isotropic mutation, in widths of the bounds",
           at_least(0));
  v.number("line_sigma", line_sigma,
           "standard deviation of the mutation along the line to another elite, in distances to it", at_least(0));
  v.number("reset_rate", reset_rate, "probability of a parameter to be drawn anew", between(0, 1));
  v.number("lattice", lattice,
           "step of the lattice on which these are drawn, in widths of the bounds; below 1e-9: none", between(0, 1));
}

Varier::Varier(Variation variation, std::vector<Interval> box, Index parameters, StreamKey key)
    : variation_(variation), box_(std::move(box)), iso_(Vector::Constant(parameters, variation.iso_sigma)), key_(key) {
  for (std::size_t p = 0; p < box_.size(); ++p) iso_(static_cast<Index>(p)) *= box_[p].high - box_[p].low;
}

Rng Varier::rng(Purpose purpose, std::uint64_t solution) const {
  StreamKey key = key_;
  key.purpose = purpose;
  key.candidate = solution;
  return Rng(key);
}

void Varier::draw(std::uint64_t first, MatrixView X) const {
  for (Index i = 0; i < X.rows(); ++i) {
    Rng random = rng(Purpose::random_policy, first + static_cast<std::uint64_t>(i));
    for (Index p = 0; p < X.cols(); ++p)
      X(i, p) = variation_.kind == Variation::Kind::reset
                    ? lattice_point(p, random)
                    : random.uniform(box_[static_cast<std::size_t>(p)].low, box_[static_cast<std::size_t>(p)].high);
  }
}

void Varier::draw_about(const Vector& start, std::uint64_t first, MatrixView X) const {
  const Matrix& N = normals(first, X.rows(), X.cols());
  for (Index p = 0; p < X.cols(); ++p) X.col(p) = (start(p) + iso_(p) * N.col(p).array()).matrix();
  clip(X);
}

void Varier::draw_near(const Matrix& examples, double share, double sigma, std::uint64_t first, MatrixView X) const {
  draw(first, X);
  for (Index i = 0; i < X.rows(); ++i) {
    Rng random = rng(Purpose::variation, first + static_cast<std::uint64_t>(i));
    if (random.uniform() >= share) continue;
    const Index example = random.below(examples.rows());
    for (Index p = 0; p < X.cols(); ++p) {
      const Interval& side = box_[static_cast<std::size_t>(p)];
      X(i, p) = examples(example, p) + sigma * (side.high - side.low) * random.normal();
    }
  }
  clip(X);
}

void Varier::vary(const Archive& archive, std::uint64_t first, MatrixView X) const {
  if (variation_.kind == Variation::Kind::reset) return reset(archive, first, X);
  add_normals(archive, first, variation_.kind == Variation::Kind::iso_line, X);
  clip(X);
}

void Varier::add_normals(const Archive& archive, std::uint64_t first, bool line, MatrixView X) const {
  const Index P = X.cols();
  const Matrix& N = normals(first, X.rows(), P + line);
  for (Index i = 0; i < X.rows(); ++i) {
    Rng select = rng(Purpose::selection, first + static_cast<std::uint64_t>(i));
    const auto one = archive.solution(select.below(archive.size()));
    const auto other = archive.solution(select.below(archive.size()));
    const double along = line ? variation_.line_sigma * N(i, P) : 0;
    for (Index p = 0; p < P; ++p) X(i, p) = one(p) + along * (other(p) - one(p)) + iso_(p) * N(i, p);
  }
}

void Varier::reset(const Archive& archive, std::uint64_t first, MatrixView X) const {
  for (Index i = 0; i < X.rows(); ++i) {
    Rng random = rng(Purpose::variation, first + static_cast<std::uint64_t>(i));
    X.row(i) = archive.solution(random.below(archive.size())).transpose();
    for (Index p = 0; p < X.cols(); ++p)
      if (random.uniform() < variation_.reset_rate) X(i, p) = lattice_point(p, random);
  }
}

double Varier::lattice_point(Index parameter, Rng& rng) const {
  const Interval& box = box_[static_cast<std::size_t>(parameter)];
  if (variation_.lattice < kFinestLattice) return rng.uniform(box.low, box.high);
  const auto steps = static_cast<Index>(std::floor(1 / variation_.lattice + 1e-9));
  const double at = std::min(1.0, static_cast<double>(rng.below(steps + 1)) * variation_.lattice);
  return box.low + at * (box.high - box.low);
}

void Varier::clip(MatrixView X) const {
  for (std::size_t p = 0; p < box_.size(); ++p)
    X.col(static_cast<Index>(p)) = X.col(static_cast<Index>(p)).cwiseMax(box_[p].low).cwiseMin(box_[p].high);
}

Matrix& Varier::normals(std::uint64_t first, Index rows, Index columns) const {
  thread_local Matrix normals;
  thread_local std::vector<std::uint64_t> solutions, zeros;
  normals.resize(rows, columns);
  solutions.resize(static_cast<std::size_t>(rows));
  zeros.assign(static_cast<std::size_t>(rows), 0);
  for (std::size_t i = 0; i < solutions.size(); ++i) solutions[i] = first + i;
  StreamKey key = key_;
  key.purpose = Purpose::variation;
  fill_normals(key, solutions.data(), zeros.data(), 0, normals);
  return normals;
}

}  // namespace rehearse::qd
