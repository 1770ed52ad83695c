// The adjoint of MomentMatching.

#include "rehearse/gp/sizes.hpp"
#include "rehearse/moments/moment_geometry.hpp"
#include "rehearse/moments/moment_matching.hpp"

namespace rehearse::moments {

void MomentMatching::mean_adjoint(const Gaussian& input, const MomentTape& tape, Index a, double by_mean,
                                  const ConstVectorView& by_gain, Gaussian& input_adjoint, TermAdjoint* adjoint) const {
  thread_local Vector by_kernel, g;  // by w_i q_i; that times w_i q_i
  const MeanGeometry geometry(input, term(a));
  const Matrix& points = tape.points[at(centres_of_[at(a)])];
  const Index D = inputs_;
  const SmallVector by_first = geometry.inverse * by_gain;
  by_kernel.noalias() = points * by_first;
  by_kernel.array() += by_mean;
  g = by_kernel.array() * tape.kernels[at(a)].array() * weights_[at(a)].array();
  SmallVector first(D);
  Small second(D, D);
  PointSums sums{0, first.data(), second.data()};
  point_sums(weighted(a, tape, g.data()), D, sums);
  const Small gain_part = by_first * tape.gains.col(a).transpose();
  const Small by_B = (geometry.inverse * second * geometry.inverse - sums.total * geometry.inverse -
                      (gain_part + gain_part.transpose())) /
                     2;
  input_adjoint.mean += geometry.inverse * first - tape.means(a) * by_first;
  input_adjoint.covariance += by_B;
  if (!adjoint) return;
  const Index n = term(a).size();
  const auto q = (tape.kernels[at(a)].array() * weights_[at(a)].array()).head(n).matrix();
  adjoint->centres += q * by_first.transpose() - g.head(n).asDiagonal() * points.topRows(n) * geometry.inverse;
  adjoint->weights += by_kernel.head(n).cwiseProduct(tape.kernels[at(a)].head(n));
  adjoint->log_lengths.array() +=
      sums.total + 2 * by_B.diagonal().array() / inverse_squares(term(a).log_lengths).array();
}

void MomentMatching::pair_adjoint(const Gaussian& input, const MomentTape& tape, Index p, double by,
                                  std::vector<TermAdjoint>& adjoints) const {
  const auto [a, b] = pairs_[at(p)];
  const Index D = inputs_;
  const PairGeometry g(input, term(a), term(b));
  const double* kept = tape.sums.col(p).data();
  const Small aa = Eigen::Map<const Matrix>(kept, D, D), bb = Eigen::Map<const Matrix>(kept + D * D, D, D),
              ab = Eigen::Map<const Matrix>(kept + 2 * D * D, D, D);
  const Small QNQ = g.Q * g.spread(aa, bb, ab) * g.Q;
  const SmallVector by_both = -2 * QNQ.diagonal() - tape.pairs(0, p) * g.Q.diagonal();
  const auto side = [&](Index k, Index own, const SmallVector& A, const SmallVector& B, const Small& second,
                        const Small& cross, double factor) {
    const Index n = term(own).size();
    const auto& rows = tape.rows[at(2 * p + k)];
    const double scale = factor * g.shrinkage.scale;
    const Matrix weighted_rows = scale * term(own).weights.asDiagonal() * rows.topRows(n);
    const Matrix spread =
        weighted_rows.col(0).asDiagonal() * tape.points[at(centres_of_[at(own)])].topRows(n) * A.asDiagonal();
    TermAdjoint& adjoint = adjoints[at(own)];
    adjoint.centres += 2 * (spread + weighted_rows.rightCols(D) * B.asDiagonal()) * (g.Q * A.asDiagonal()) - spread;
    adjoint.weights += scale * rows.col(0).head(n);
    const Small along = g.Q * (A.asDiagonal() * second + B.asDiagonal() * cross.transpose());
    const SmallVector by_A = by_both - second.diagonal() / 2 + 2 * along.diagonal();
    adjoint.log_lengths -= 2 * factor * by_A.cwiseProduct(A);
  };
  side(0, a, g.A, g.B, aa, ab, a == b ? 2 * by : by);
  if (a != b) side(1, b, g.B, g.A, bb, ab.transpose(), by);
}

void MomentMatching::adjoint(const Gaussian& input, const MomentTape& tape, const Transformed& result,
                             const Transformed& adjoint, Gaussian& input_adjoint,
                             std::vector<TermAdjoint>* terms) const {
  const Index D = inputs_;
  check(input), check(input_adjoint);
  for (const Transformed* one : {&result, &adjoint}) {
    gp::require_size("outputs of moments", one->mean.size(), outputs_);
    gp::require_shape("covariance of moments", one->covariance.rows(), one->covariance.cols(), outputs_, outputs_);
    gp::require_shape("gain of moments", one->gain.rows(), one->gain.cols(), D, outputs_);
  }
  if (terms) gp::require_size("terms of moments", static_cast<Index>(terms->size()), static_cast<Index>(terms_.size()));
  const Matrix symmetric = adjoint.covariance + adjoint.covariance.transpose();
  const Vector by_mean = adjoint.mean - symmetric * result.mean;
  for (Index a = 0; a < static_cast<Index>(terms_.size()); ++a) {
    const Index o = term(a).output;
    mean_adjoint(input, tape, a, by_mean(o), adjoint.gain.col(o), input_adjoint, terms ? &(*terms)[at(a)] : nullptr);
  }
  for (Index p = 0; p < static_cast<Index>(pairs_.size()); ++p) {
    const auto [a, b] = pairs_[at(p)];
    const double by = symmetric(term(a).output, term(b).output) * (a == b ? 0.5 : 1.0);
    const auto column = tape.pairs.col(p);
    input_adjoint.mean += by * column.segment(1, D);
    input_adjoint.covariance += by * Eigen::Map<const Matrix>(column.data() + 1 + D, D, D);
    if (terms) pair_adjoint(input, tape, p, by, *terms);
  }
}

std::vector<TermAdjoint> MomentMatching::zero_adjoints() const {
  std::vector<TermAdjoint> zeros;
  for (const MomentTerm& t : terms_)
    zeros.push_back({Matrix::Zero(t.size(), inputs_), Vector::Zero(inputs_), Vector::Zero(t.size())});
  return zeros;
}

}  // namespace rehearse::moments
