#include "rehearse/optim/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/QR>

#include "rehearse/core/errors.hpp"

namespace rehearse::optim {
namespace {

constexpr double kFirstDamping = 1e-6, kLeastDamping = 1e-12;
constexpr int kMostDampings = 14;

double sum_of_squares(const Vector& r) {
  return r.allFinite() ? r.squaredNorm() : std::numeric_limits<double>::infinity();
}

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

struct Step {
  Vector d;
  bool cut = false;  // by the box
};

/// The d of the least ‖c + R d‖² + damping ‖D d‖², D the lengths of R's columns. Coordinates that would leave the box
/// go to its border, and the others to what is best then; one that changes nothing stays.
Step best_step(const Linear& linear, const Vector& low, const Vector& high, double damping) {
  const Vector lengths = linear.R.colwise().norm().transpose();
  const Index rows = linear.R.rows();
  Step step{Vector::Zero(lengths.size())};
  std::vector<Index> free;
  for (Index i = 0; i < lengths.size(); ++i)
    if (lengths(i) > 0 && low(i) < high(i)) free.push_back(i);
  while (!free.empty()) {
    const auto q = static_cast<Index>(free.size());
    step.d(free).setZero();
    Matrix A = Matrix::Zero(rows + q, q);
    A.topRows(rows) = linear.R(Eigen::all, free);
    A.bottomRows(q).diagonal() = std::sqrt(damping) * lengths(free);
    Vector b = Vector::Zero(rows + q);
    b.head(rows) = -(linear.c + linear.R * step.d);
    const Vector solved = A.colPivHouseholderQr().solve(b);
    step.d(free) = solved;
    const auto leaves = [&](Index i) { return !(low(i) <= step.d(i) && step.d(i) <= high(i)); };
    const auto kept = std::stable_partition(free.begin(), free.end(), [&](Index i) { return !leaves(i); });
    if (kept == free.end()) break;
    for (auto i = kept; i != free.end(); ++i) {
      step.d(*i) = std::isfinite(step.d(*i)) ? std::clamp(step.d(*i), low(*i), high(*i)) : 0;
      step.cut = step.cut || step.d(*i) != 0;
    }
    free.erase(kept, free.end());
  }
  return step;
}

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
      const Step to = best_step(linear, problem_.low - x_, problem_.high - x_, damping_);
      const double promised = linear.gain(to.d);
      const bool worth = promised > tolerance * value_;
      if (!worth && !to.cut) return i == 0 ? Made::none : Made::misled;
      if (worth && move((x_ + to.d).cwiseMax(problem_.low).cwiseMin(problem_.high), promised)) return Made::one;
      damping_ = std::max(10 * damping_, kFirstDamping);
    }
    return Made::misled;
  }

  /// Moves to x if the sum is less there; false if not.
  bool move(const Vector& x, double promised) {
    Vector r = problem_.errors(x);
    ++evaluations_;
    const double gain = value_ - sum_of_squares(r);
    if (!(gain > 0)) return false;
    if (gain > 0.75 * promised) damping_ = std::max(damping_ / 10, kLeastDamping);
    if (gain < 0.25 * promised) damping_ = std::max(damping_ * 4, kFirstDamping);
    x_ = x;
    r_ = std::move(r);
    value_ = r_.squaredNorm();
    return true;
  }

  const SquaresProblem& problem_;
  Vector x_, r_;
  double value_;
  double damping_ = kFirstDamping;
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
