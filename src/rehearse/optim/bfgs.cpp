#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/box.hpp"
#include "rehearse/optim/gradient.hpp"

namespace rehearse::optim {
namespace {

constexpr double kFirstStep = 1;              // length of the first step where nothing is known
constexpr double kLongestStep = 4;            // of a coordinate, at the beginning of a line search
constexpr double kRise = 1e-4, kSlope = 0.9;  // Nocedal and Wright 2006, eq. 3.6, for a maximum
constexpr int kTrials = 20;                   // of a line search
constexpr double kRounding = 1e3;             // tolerances that a failed line search may leave

void check(const Vector& start, const BfgsOptions& options) {
  Violations violations;
  violations.add(field_violations("bfgs", options));
  violations.add(start_violations(start, {}));
  violations.throw_if_any();
}

struct Point {
  Vector x, gradient;
  double value = kNaN;
  bool ok() const { return std::isfinite(value) && gradient.allFinite(); }
};

/// A point on a line: the step, the value and the slope there.
struct Mark {
  double step, value, slope;
};

/// The maximum of the cubic through both ends, kept away from them; `high` may have no value.
double between(const Mark& low, const Mark& high) {
  const double width = high.step - low.step;
  if (!std::isfinite(high.value)) return low.step + 0.25 * width;
  const double z = 3 * (high.value - low.value) / width - low.slope - high.slope;
  const double root = std::sqrt(std::max(z * z - low.slope * high.slope, 0.0));
  const double t = 1 - (root - high.slope - z) / (low.slope - high.slope + 2 * root);
  return low.step + width * (std::isfinite(t) ? std::clamp(t, 0.1, 0.9) : 0.5);
}

class Search {
 public:
  Search(const Differentiable& objective, const BfgsOptions& options) : objective_(objective), options_(options) {}

  GradientResult run(const Vector& start, Matrix* inverse_hessian) {
    at_ = evaluate(start);
    const Index n = start.size();
    if (inverse_hessian && inverse_hessian->rows() == n && inverse_hessian->cols() == n && inverse_hessian->allFinite())
      inverse_ = *inverse_hessian;
    const std::string stop = at_.ok() ? climb() : "no finite value";
    if (inverse_hessian) *inverse_hessian = inverse_;
    return {at_.x, at_.value, evaluations_, stop};
  }

 private:
  std::string climb() {
    bool updated = false;  // before, what the inverse Hessian promises is not to be trusted
    while (evaluations_ < options_.max_evaluations) {
      if (inverse_.size() == 0) forget();
      Vector direction = inverse_ * at_.gradient;
      if (!(direction.dot(at_.gradient) > 0)) {
        forget();
        direction = inverse_ * at_.gradient;
      }
      const double slope = direction.dot(at_.gradient);
      const double tolerance = options_.relative_tolerance * std::max(1.0, std::abs(at_.value));
      if (!(slope > 0) || (updated && slope / 2 < tolerance)) return "converged";
      Point next = search_line(direction, slope);
      if (next.ok()) {
        update(next);
        at_ = std::move(next);
        updated = true;
      } else if (scaled_ || slope / 2 < kRounding * tolerance) {
        return evaluations_ < options_.max_evaluations ? "converged" : "max_evaluations";
      } else {
        forget();
      }
    }
    return "max_evaluations";
  }

  Point evaluate(const Vector& x) {
    Point point{x, Vector::Zero(x.size())};
    point.value = objective_(point.x, point.gradient);
    ++evaluations_;
    return point;
  }

  /// Steepest ascent by kFirstStep.
  void forget() {
    inverse_ = Matrix::Identity(at_.x.size(), at_.x.size()) * (kFirstStep / std::max(at_.gradient.norm(), 1e-300));
    scaled_ = true;
  }

  /// A point that fulfils Wolfe's conditions, or at least the first; not ok if there is none.
  Point search_line(const Vector& direction, double slope) {
    Point found;
    Mark low{0, at_.value, slope}, high{kInf, 0, 0};
    double step = std::min(1.0, kLongestStep / direction.cwiseAbs().maxCoeff());
    for (int i = 0; i < kTrials && evaluations_ < options_.max_evaluations; ++i) {
      Point next = evaluate(at_.x + step * direction);
      const Mark mark{step, next.ok() ? next.value : kNaN, next.gradient.dot(direction)};
      if (mark.value >= at_.value + kRise * step * slope && mark.value >= low.value) {
        found = std::move(next);
        low = mark;
        if (mark.slope <= kSlope * slope) break;
        step = std::isfinite(high.step) ? between(low, high) : 3 * step;
      } else {
        high = mark;
        step = between(low, high);
      }
    }
    return found;
  }

  /// Nocedal and Wright 2006, eqs 6.17 and 6.20, for a maximum.
  void update(const Point& next) {
    const Vector s = next.x - at_.x, y = at_.gradient - next.gradient;
    const double sy = s.dot(y);
    if (!(sy > 1e-12 * s.norm() * y.norm())) return;
    if (scaled_) inverse_ = Matrix::Identity(s.size(), s.size()) * (sy / y.squaredNorm());
    scaled_ = false;
    const Vector Hy = inverse_ * y;
    inverse_ += ((sy + y.dot(Hy)) / (sy * sy)) * (s * s.transpose()) - (Hy * s.transpose() + s * Hy.transpose()) / sy;
  }

  const Differentiable& objective_;
  const BfgsOptions& options_;
  Point at_;
  Matrix inverse_;       // of the negative Hessian
  bool scaled_ = false;  // the inverse is no more than a multiple of the identity
  Index evaluations_ = 0;
};

}  // namespace

GradientResult maximise_bfgs(const Differentiable& objective, const Vector& start, const BfgsOptions& options,
                             Matrix* inverse_hessian) {
  check(start, options);
  return Search(objective, options).run(start, inverse_hessian);
}

}  // namespace rehearse::optim
