#include "rehearse/optim/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/QR>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/damping.hpp"

namespace rehearse::optim {
namespace {

constexpr double kLeastDamping = 1e-12;
constexpr double kFlat = 1e-12;  // of ‖c‖: slopes below are rounding
constexpr int kMostDampings = 14;

double sum_of_squares(const Vector& r) { return r.allFinite() ? r.squaredNorm() : kInf; }

/// ‖r + J d‖² as ‖c + R d‖² and a constant, with as many rows as there are coordinates.
struct Linear {
  Linear(const Matrix& J, const Vector& r) {
    const Index rank = std::min(J.rows(), J.cols());
    const Eigen::HouseholderQR<Matrix> qr(J);
    R = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
    c = (qr.householderQ().adjoint() * r).head(rank);
  }
  double gain(const Vector& d) const { return c.squaredNorm() - (c + R * d).squaredNorm(); }

  Matrix R;
  Vector c;
};

/// The d of the least ‖c + R d‖² + damping ‖D d‖² in a box around 0, D the lengths of R's columns; a coordinate that
/// changes nothing stays. Coordinates are held at the bound that they reach first, and released where the sum falls
/// inwards (Stark and Parker 1995).
class BoxStep {
 public:
  BoxStep(const Linear& linear, const Vector& low, const Vector& high, double damping)
      : linear_(linear),
        low_(low),
        high_(high),
        lengths_(linear.R.colwise().norm().transpose()),
        damping_(damping),
        d_(Vector::Zero(low.size())) {
    for (Index i = 0; i < d_.size(); ++i)
      if (lengths_(i) > 0 && low(i) < high(i)) free_.push_back(i);
  }

  Vector solve() {
    const Index most_rounds = 10 * (d_.size() + 1);  // against rounding, which may hold and release for ever
    for (Index round = 0; round < most_rounds; ++round) {
      const Vector best = best_of_free();
      if (!best.allFinite()) break;
      if (!hold_on_the_way(best) && !release()) break;
    }
    return d_;
  }

 private:
  /// d with the free coordinates at their best, in the box or not.
  Vector best_of_free() const {
    Vector best = d_;
    if (free_.empty()) return best;
    const auto q = static_cast<Index>(free_.size());
    const Index rows = linear_.R.rows();
    best(free_).setZero();
    Matrix A = Matrix::Zero(rows + q, q);
    A.topRows(rows) = linear_.R(Eigen::all, free_);
    A.bottomRows(q).diagonal() = std::sqrt(damping_) * lengths_(free_);
    Vector b = Vector::Zero(rows + q);
    b.head(rows) = -(linear_.c + linear_.R * best);
    const Vector solved = A.colPivHouseholderQr().solve(b);
    best(free_) = solved;
    return best;
  }

  /// Goes towards `best` up to the first bound and holds that coordinate; all the way, and false, if none is met.
  bool hold_on_the_way(const Vector& best) {
    double part = 1;
    auto first = free_.end();
    for (auto i = free_.begin(); i != free_.end(); ++i) {
      const double end = at_bound(*i, best(*i));
      if (end == best(*i)) continue;
      const double reach = (end - d_(*i)) / (best(*i) - d_(*i));
      if (first == free_.end() || reach < part) part = reach, first = i;
    }
    if (first == free_.end()) {
      d_ = best;
      return false;
    }
    d_ += part * (best - d_);
    d_(*first) = at_bound(*first, best(*first));
    held_.push_back(*first);
    free_.erase(first);
    return true;
  }

  /// Frees the held coordinate along which the sum falls most steeply inwards; false if there is none.
  bool release() {
    const Vector slope =
        linear_.R.transpose() * (linear_.c + linear_.R * d_) + damping_ * lengths_.cwiseAbs2().cwiseProduct(d_);
    double steepest = kFlat * linear_.c.norm();
    auto chosen = held_.end();
    for (auto i = held_.begin(); i != held_.end(); ++i) {
      const double inwards = (d_(*i) >= high_(*i) ? slope(*i) : -slope(*i)) / lengths_(*i);
      if (inwards > steepest) steepest = inwards, chosen = i;
    }
    if (chosen == held_.end()) return false;
    free_.push_back(*chosen);
    held_.erase(chosen);
    return true;
  }

  double at_bound(Index i, double value) const { return std::clamp(value, low_(i), high_(i)); }

  const Linear& linear_;
  const Vector low_, high_, lengths_;
  const double damping_;
  Vector d_;
  std::vector<Index> free_, held_;
};

class Search {
 public:
  Search(const SquaresProblem& problem, const Vector& start)
      : problem_(problem), x_(start), r_(problem.errors(start)), value_(sum_of_squares(r_)) {}

  SquaresResult run(const SquaresOptions& options) {
    bool converged = false;
    for (Index i = 0; i < options.max_steps && !converged && std::isfinite(value_); ++i) {
      const Made made = step(options.tolerance);
      if (made == Made::misled) break;
      converged = made == Made::none;
    }
    return {x_, value_, evaluations_, converged};
  }

 private:
  enum class Made { one, none, misled };

  Made step(double tolerance) {
    if (value_ <= problem_.negligible) return Made::none;
    const Matrix J = problem_.derivatives(x_, r_);
    if (!J.allFinite()) return Made::misled;
    const Linear linear(J, r_);
    for (int i = 0; i < kMostDampings; ++i) {
      const Vector d = BoxStep(linear, problem_.low - x_, problem_.high - x_, damping_.value()).solve();
      const double promised = linear.gain(d);
      if (!(promised > tolerance * value_)) return i == 0 ? Made::none : Made::misled;
      if (move((x_ + d).cwiseMax(problem_.low).cwiseMin(problem_.high), promised)) return Made::one;
      damping_.refuse();
    }
    return Made::misled;
  }

  /// Moves to x if the sum is less there; false if not.
  bool move(const Vector& x, double promised) {
    Vector r = problem_.errors(x);
    ++evaluations_;
    const double gain = value_ - sum_of_squares(r);
    if (!(gain > 0)) return false;
    damping_.judge(gain, promised);
    x_ = x;
    r_ = std::move(r);
    value_ = r_.squaredNorm();
    return true;
  }

  const SquaresProblem& problem_;
  Vector x_, r_;
  double value_;
  Damping damping_{kLeastDamping};
  Index evaluations_ = 1;
};

}  // namespace

SquaresResult minimise_squares(const SquaresProblem& problem, const Vector& start, const SquaresOptions& options) {
  Violations violations;
  const Index n = start.size();
  violations.require(n > 0 && problem.low.size() == n && problem.high.size() == n,
                     "start, low and high have different sizes or none");
  if (problem.low.size() == n && problem.high.size() == n)
    violations.require((problem.low.array() <= start.array()).all() && (start.array() <= problem.high.array()).all(),
                       "start is outside the box, or the box is empty");
  violations.throw_if_any();
  return Search(problem, start).run(options);
}

}  // namespace rehearse::optim
