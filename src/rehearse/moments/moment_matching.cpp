#include "rehearse/moments/moment_matching.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/sizes.hpp"
#include "rehearse/moments/moment_geometry.hpp"
#include "rehearse/moments/moment_narrow.hpp"

namespace rehearse::moments {
namespace {

constexpr double kWorthSpreading = 30000;  // kernel values

/// True if two matrices are equal; sizes may differ, unlike in Eigen's comparison.
bool are_equal(const Matrix& a, const Matrix& b) { return a.rows() == b.rows() && a.cols() == b.cols() && a == b; }

}  // namespace

MomentMatching::MomentMatching(std::vector<MomentTerm> terms, Index outputs, bool parameters)
    : terms_(std::move(terms)), outputs_(outputs), parameters_(parameters) {
  require_terms(terms_, outputs, parameters);
  inputs_ = terms_.front().inputs();
  pair_weights_.resize(terms_.size());
  for (Index a = 0; a < static_cast<Index>(terms_.size()); ++a) {
    const MomentTerm& t = term(a);
    const Index n = t.size(), stride = moment_stride(n);
    for (Index b = 0; b <= a; ++b) pairs_.push_back({b, a}), work_ += static_cast<double>(n * term(b).size());
    std::size_t place = 0;
    while (place < centres_.size() && !are_equal(*centres_[place], t.centres)) ++place;
    if (place == centres_.size()) centres_.push_back(&t.centres);
    centres_of_.push_back(static_cast<Index>(place));
    weights_.push_back(Vector::Zero(stride));
    weights_.back().head(n) = t.weights;
    for (Index b = 0; b <= a; ++b) narrow_limits_.push_back(narrow_limit(term(b), t));
    if (t.reduction.size() == 0) continue;
    pair_weights_[at(a)] = pair_weights(t.weights * t.weights.transpose() - t.reduction);
  }
}

WeightedPoints MomentMatching::weighted(Index a, const MomentTape& tape, const double* weights) const {
  const Matrix& points = tape.points[at(centres_of_[at(a)])];
  return {points.data(), weights, term(a).size(), points.rows()};
}

void MomentMatching::prepare(const Gaussian& input, MomentTape& tape) const {
  const Index terms = static_cast<Index>(terms_.size()), pairs = static_cast<Index>(pairs_.size()), D = inputs_;
  tape.points.resize(centres_.size());
  for (std::size_t k = 0; k < centres_.size(); ++k) {
    const Index n = centres_[k]->rows(), stride = moment_stride(n);
    tape.points[k].resize(stride, D);
    tape.points[k].topRows(n) = centres_[k]->rowwise() - input.mean.transpose();
    tape.points[k].bottomRows(stride - n).setZero();
  }
  tape.kernels.resize(terms_.size());
  tape.means.resize(terms, 1);
  tape.gains.resize(D, terms);
  tape.pairs.resize(1 + D + D * D, pairs);
  tape.covariances.setConstant(pairs, kNaN);
  tape.ok.resize(terms_.size() + pairs_.size());
  if (!parameters_) return;
  tape.sums.resize(3 * D * D, pairs);
  tape.rows.resize(2 * pairs_.size());
}

/// q_i = w_i E[c(x, x_i)]: mean Σ q_i, gain B⁻¹ Σ q_i z_i (Deisenroth 2010, section 2.3).
bool MomentMatching::mean(const Gaussian& input, Index a, MomentTape& tape) const {
  thread_local Vector q;
  const MeanGeometry g(input, term(a));
  if (!g.shrinkage.ok) return false;
  Vector& kernels = tape.kernels[at(a)];
  kernels.resize(weights_[at(a)].size());
  mean_correlations(weighted(a, tape, weights(a)), inputs_, g.inverse.data(), g.shrinkage.scale, kernels.data());
  q = kernels.cwiseProduct(weights_[at(a)]);
  SmallVector first(inputs_);
  PointSums sums{0, first.data(), nullptr};
  point_sums(weighted(a, tape, q.data()), inputs_, sums);
  tape.means(a) = sums.total;
  tape.gains.col(a) = g.inverse * first;
  return true;
}

bool MomentMatching::pair(const Gaussian& input, Index p, MomentTape& tape) const {
  thread_local Vector scratch;
  const auto [a, b] = pairs_[at(p)];
  const Index D = inputs_;
  const PairGeometry g(input, term(a), term(b));
  if (!g.ok) return false;
  if (!parameters_ && narrow_pair(input, p, g, tape)) return true;
  const Small AQ = g.A.asDiagonal() * g.Q, BQ = g.B.asDiagonal() * g.Q;
  Small form_a = AQ * g.A.asDiagonal(), form_b = BQ * g.B.asDiagonal();
  const Small form_c = 2 * AQ * g.B.asDiagonal();
  form_a.diagonal() -= g.A / 2, form_b.diagonal() -= g.B / 2;

  const WeightedPoints points_a = weighted(a, tape, weights(a)), points_b = weighted(b, tape, weights(b));
  scratch.resize(std::max(pair_scratch(points_a), pair_scratch(points_b)));
  SmallVector first_a(D), first_b(D);
  Small aa(D, D), bb(D, D), ab(D, D);
  PairSums sums{{0, first_a.data(), aa.data()}, {0, nullptr, nullptr}, ab.data(), nullptr};
  if (a != b) sums.b = {0, first_b.data(), bb.data()};
  const auto rows = [&](Index k, const WeightedPoints& points) {
    Matrix& matrix = tape.rows[at(2 * p + k)];
    matrix.resize(points.stride, D + 1);
    return matrix.data();
  };
  if (parameters_ && a != b) {  // the mirror image, for its rows alone
    PairSums mirror = sums;
    mirror.b.first = nullptr;
    mirror.rows = rows(1, points_b);
    const Small form_mirror = form_c.transpose();
    pair_sums(points_b, points_a, D, {form_b.data(), form_a.data(), form_mirror.data()}, nullptr, mirror,
              scratch.data());
  }
  if (parameters_) sums.rows = rows(0, points_a);
  const Matrix& own_weights = pair_weights_[at(a)];
  pair_sums(points_a, points_b, D, {form_a.data(), form_b.data(), form_c.data()},
            a == b && own_weights.size() > 0 ? own_weights.data() : nullptr, sums, scratch.data());
  if (a == b) first_b = first_a, bb = aa;  // a network with itself

  const double scale = g.shrinkage.scale;
  first_a *= scale, first_b *= scale, aa *= scale, bb *= scale, ab *= scale;
  sums.b = {0, first_b.data(), bb.data()};
  keep(p, g, scale * sums.a.total, sums, tape);
  if (!parameters_) return true;
  auto kept = tape.sums.col(p);
  kept.segment(0, D * D) = aa.reshaped();
  kept.segment(D * D, D * D) = bb.reshaped();
  kept.segment(2 * D * D, D * D) = ab.reshaped();
  return true;
}

/// E[f g] and its derivatives, from sums that include the scale.
void MomentMatching::keep(Index p, const PairGeometry& g, double total, const PairSums& sums, MomentTape& tape) const {
  const Index D = inputs_;
  const auto vector = [&](const double* data) { return SmallVector(Eigen::Map<const Vector>(data, D)); };
  const auto matrix = [&](const double* data) { return Small(Eigen::Map<const Matrix>(data, D, D)); };
  auto column = tape.pairs.col(p);
  column(0) = total;
  column.segment(1, D) = g.back * (g.A.cwiseProduct(vector(sums.a.first)) + g.B.cwiseProduct(vector(sums.b.first)));
  const Small spread = g.spread(matrix(sums.a.second), matrix(sums.b.second), matrix(sums.cross));
  Eigen::Map<Matrix>(column.data() + 1 + D, D, D) = (g.back * spread * g.back.transpose() - total * g.K) / 2;
}

/// False, and nothing done, if the input is too wide for it.
bool MomentMatching::narrow_pair(const Gaussian& input, Index p, const PairGeometry& g, MomentTape& tape) const {
  const auto [a, b] = pairs_[at(p)];
  const bool own = a == b && term(a).reduction.size() > 0;
  if (own && term(a).factor.size() == 0) return false;
  const Index D = inputs_;
  const auto points = [&](Index k) -> const Matrix& { return tape.points[at(centres_of_[at(k)])]; };
  const auto forward = [&](const SmallVector& A) { return Small(A.asDiagonal() * g.Q * A.asDiagonal()); };
  if (!crosses_within(points(a), forward(g.A), points(b), forward(g.B), narrow_limits_[at(p)])) return false;
  const auto side = [&](Index k, const SmallVector& A) {
    const MeanGeometry mean(input, term(k));
    const auto& root = mean.shrinkage.root;
    const Matrix narrowing = root.asDiagonal() * (mean.shrinkage.scaled * mean.shrinkage.inverse) * root.asDiagonal();
    NarrowSide side{term(k), points(k), forward(A), forward(A) - narrowing / 2, 0, Vector(points(k).rows())};
    side.form.diagonal() -= A / 2;
    side.scale_change = std::log(g.shrinkage.scale) / 2 - std::log(mean.shrinkage.scale);
    mean_correlations(weighted(k, tape, weights(k)), D, mean.inverse.data(), mean.shrinkage.scale,
                      side.correlations.data());
    side.correlations.conservativeResize(term(k).size());
    return side;
  };
  const NarrowSide side_a = side(a, g.A), side_b = side(b, g.B);
  Vector first_a(D), first_b(D);
  Matrix aa(D, D), bb(D, D), ab(D, D);
  PairSums sums{{0, first_a.data(), aa.data()}, {0, first_b.data(), bb.data()}, ab.data(), nullptr};
  const Matrix C = 2 * g.A.asDiagonal() * g.Q * g.B.asDiagonal();
  const double mean_a = term(a).weights.dot(side_a.correlations), mean_b = term(b).weights.dot(side_b.correlations);
  tape.covariances(p) = narrow_sums(side_a, side_b, C, std::log(g.shrinkage.scale), own, sums);
  keep(p, g, tape.covariances(p) + mean_a * mean_b, sums, tape);
  return true;
}

bool MomentMatching::combine(const MomentTape& tape, Transformed& result) const {
  result.mean.setZero(outputs_);
  result.covariance.setZero(outputs_, outputs_);
  result.gain.setZero(inputs_, outputs_);
  for (std::size_t a = 0; a < terms_.size(); ++a) {
    const Index o = terms_[a].output;
    result.mean(o) += tape.means(static_cast<Index>(a));
    result.gain.col(o) += tape.gains.col(static_cast<Index>(a));
    result.covariance(o, o) += terms_[a].variance;
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto [a, b] = pairs_[p];
    const double narrow = tape.covariances(static_cast<Index>(p));
    const double covariance =
        std::isnan(narrow) ? tape.pairs(0, static_cast<Index>(p)) - tape.means(a) * tape.means(b) : narrow;
    result.covariance(term(a).output, term(b).output) += covariance;
    if (a != b) result.covariance(term(b).output, term(a).output) += covariance;
  }
  return result.mean.allFinite() && result.covariance.allFinite() && result.gain.allFinite();
}

void MomentMatching::check(const Gaussian& input) const {
  gp::require_size("inputs of moments", input.mean.size(), inputs_);
  gp::require_shape("covariance of moments' inputs", input.covariance.rows(), input.covariance.cols(), inputs_,
                    inputs_);
}

bool MomentMatching::forward(const Gaussian& input, MomentTape& tape, Transformed& result,
                             const Evaluator& evaluator) const {
  check(input);
  if (!input.mean.allFinite() || !input.covariance.allFinite()) return false;
  prepare(input, tape);
  const Index pairs = static_cast<Index>(pairs_.size()), tasks = pairs + static_cast<Index>(terms_.size());
  const auto task = [&](Index k) { tape.ok[at(k)] = k < pairs ? pair(input, k, tape) : mean(input, k - pairs, tape); };
  (work_ < kWorthSpreading ? serial_evaluator() : evaluator).for_each(tasks, task);
  for (const char ok : tape.ok)
    if (!ok) return false;
  return combine(tape, result);
}

}  // namespace rehearse::moments
