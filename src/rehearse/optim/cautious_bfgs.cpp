#include "rehearse/optim/cautious_bfgs.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/box.hpp"

namespace rehearse::optim {
namespace {

constexpr double kShortestStep = 1e-7;          // ‖Δx‖ that a line search begins with at least
constexpr double kFurther = 1.1, kFarther = 5;  // extrapolation, times the step
constexpr double kMargin = 0.1;                 // of interpolation, from both ends

void check(const Vector& start, const CautiousBfgsOptions& options) {
  Violations violations;
  violations.add(field_violations("cautious_bfgs", options));
  violations.add(start_violations(start, {}));
  violations.throw_if_any();
}

/// A point on a line, for a minimum of `cost`.
struct Mark {
  double step = 0, cost = 0, slope = 0;
  Vector gradient;
  bool ok() const { return std::isfinite(cost) && std::isfinite(slope); }
};

/// The minimum of the cubic through both marks, as the distance from `a`; not finite if there is none.
double cubic_minimum(const Mark& a, const Mark& b) {
  const double x = b.step - a.step, rise = b.cost - a.cost;
  const double A = 3 * (a.slope + b.slope) * x - 6 * rise, B = 3 * rise - (2 * a.slope + b.slope) * x;
  return -a.slope * x * x / (B + std::sqrt(B * B - A * a.slope * x));
}

double extrapolated(const Mark& a, const Mark& b) {
  const double x = b.step - a.step, z = cubic_minimum(a, b);
  return a.step + (z >= x && z <= kFarther * x ? std::max(z, kFurther * x) : kFarther * x);
}

double interpolated(const Mark& a, const Mark& b) {
  const double x = b.step - a.step, z = cubic_minimum(a, b);
  return a.step + (z >= 0 && z <= x ? std::clamp(z, kMargin * x, (1 - kMargin) * x) : x / 2);
}

class Search {
 public:
  Search(const Differentiable& objective, const CautiousBfgsOptions& options)
      : objective_(objective), options_(options) {}

  GradientResult run(const Vector& start) {
    x_ = start;
    gradient_.setZero(start.size());
    cost_ = evaluate(start, gradient_);
    const bool ok = std::isfinite(cost_) && gradient_.allFinite();
    const std::string stop = ok ? descend() : "no finite value";
    return {x_, -cost_, evaluations_, stop};
  }

 private:
  std::string descend() {
    double step = 1 / (1 + gradient_.squaredNorm());
    bool failed = false;
    std::vector<double> costs;  // before each line search
    for (Index i = 0; i < options_.line_searches; ++i) {
      costs.push_back(cost_);
      if (options_.patience > 0 && i >= options_.patience && stagnates(costs.rbegin()[options_.patience]))
        return "patience";
      Vector direction = descent();
      if (!(direction.dot(gradient_) < 0)) {
        pairs_.clear();
        direction = -gradient_;
      }
      const double length = direction.norm();
      if (!(length > 0)) return "converged";
      step = std::clamp(step, kShortestStep / length, std::max(options_.longest_step, kShortestStep) / length);
      const Mark end = search_line(direction, step);
      const bool succeeded = fulfils(end);
      move(direction, end, succeeded);
      if (succeeded) {
        step = end.step;
      } else {
        if (failed) return "converged";
        pairs_.clear();
      }
      failed = !succeeded;
    }
    return "line_searches";
  }

  bool stagnates(double cost_before) const { return cost_before - cost_ < options_.patience_gain * std::abs(cost_); }

  double evaluate(const Vector& x, Vector& gradient) {
    ++evaluations_;
    const double value = objective_(x, gradient);
    gradient = -gradient;
    return -value;
  }

  /// −H g by the pairs of all line searches (Nocedal and Wright 2006, algorithm 7.4, with H_0 = I): BFGS, without the
  /// matrix.
  Vector descent() const {
    Vector q = -gradient_;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
      alpha[k] = pairs_[k].s.dot(q) / pairs_[k].sy;
      q -= alpha[k] * pairs_[k].y;
    }
    for (std::size_t k = 0; k < pairs_.size(); ++k) q += (alpha[k] - pairs_[k].y.dot(q) / pairs_[k].sy) * pairs_[k].s;
    return q;
  }

  bool descends(const Mark& m) const { return m.cost <= cost_; }
  bool steep(const Mark& m) const { return m.slope < -options_.slope * std::abs(slope_); }
  bool fulfils(const Mark& m) const {
    return m.step > 0 && descends(m) && std::abs(m.slope) <= options_.slope * std::abs(slope_);
  }

  /// At `step`, or at the first half, quarter … of the way from `from` to there that has a value.
  Mark probe(const Vector& direction, double step, const Mark& from) {
    Mark mark{.gradient = Vector::Zero(x_.size())};
    while (budget_ > 0) {
      --budget_;
      mark.step = step;
      mark.cost = evaluate(x_ + step * direction, mark.gradient);
      mark.slope = mark.gradient.dot(direction);
      if (mark.ok() && mark.gradient.allFinite()) return mark;
      step = (from.step + step) / 2;
    }
    mark.cost = kNaN;
    return mark;
  }

  /// The best point it found, which fulfils Wolfe's conditions unless the evaluations were not enough.
  Mark search_line(const Vector& direction, double step) {
    slope_ = direction.dot(gradient_);
    budget_ = options_.line_evaluations;
    Mark low{0, cost_, slope_, gradient_};
    Mark high = probe(direction, step, low);
    while (high.ok() && budget_ > 0 && descends(high) && steep(high)) {
      const double next = extrapolated(low, high);
      low = std::move(high);
      high = probe(direction, next, low);
    }
    while (high.ok()) {
      const Mark& best = low.cost > high.cost ? high : low;
      if (fulfils(best) || budget_ == 0) return best;
      Mark middle = probe(direction, interpolated(low, high), low);
      if (!middle.ok()) return best;
      (!descends(middle) || middle.slope > 0 ? high : low) = std::move(middle);
    }
    return low;
  }

  void move(const Vector& direction, const Mark& end, bool succeeded) {
    if (end.step == 0) return;
    const Vector y = end.gradient - gradient_;
    const double sy = end.step * direction.dot(y);
    if (succeeded && sy > 0) pairs_.push_back({end.step * direction, y, sy});
    x_ += end.step * direction;
    cost_ = end.cost;
    gradient_ = end.gradient;
  }

  struct Pair {
    Vector s, y;  // of a line search: the step, and the change of the gradient
    double sy;
  };

  const Differentiable& objective_;
  const CautiousBfgsOptions& options_;
  Vector x_, gradient_;  // of the cost, which is minus the value
  double cost_ = 0;
  double slope_ = 0;  // at the beginning of the line
  std::vector<Pair> pairs_;
  Index evaluations_ = 0, budget_ = 0;
};

}  // namespace

GradientResult maximise_cautious_bfgs(const Differentiable& objective, const Vector& start,
                                      const CautiousBfgsOptions& options) {
  check(start, options);
  return Search(objective, options).run(start);
}

}  // namespace rehearse::optim
