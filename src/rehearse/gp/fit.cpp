#include "rehearse/gp/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::gp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Point {
  Vector flat;
  Evidence evidence{.value = kNaN, .jitter = kNaN};
  double penalty = 0;
  double value() const { return evidence.value + penalty; }
};

/// The penalised log evidence of one output; remembers the best point it was asked about.
class Objective {
 public:
  Objective(const Inputs& inputs, const ConstVectorView& y, const Penalties& penalties, Workspace& workspace)
      : inputs_(inputs), y_(y), penalties_(penalties), workspace_(workspace) {}

  /// At flat log hyperparameters; writes the gradient unless null.
  double operator()(const Vector& flat, Vector* gradient) {
    ++evaluations_;
    const Evidence evidence = gp::evidence(inputs_, y_, flat, workspace_, gradient);
    const double penalty = gp::penalty(inputs_, flat, penalties_, gradient);
    const double value = evidence.value + penalty;
    if (std::isfinite(value) && !(value <= best_.value())) best_ = {flat, evidence, penalty};
    return value;
  }

  const Point& best() const { return best_; }
  Index evaluations() const { return evaluations_; }

 private:
  const Inputs& inputs_;
  const ConstVectorView& y_;
  const Penalties& penalties_;
  Workspace& workspace_;
  Point best_;
  Index evaluations_ = 0;
};

std::string maximise(Objective& objective, const SoftBounds& bounds, const Vector& start, const FitOptions& options) {
  const optim::Differentiable free_objective = [&](const Vector& u, Vector& gradient) {
    const double value = objective(bounds.flat(u), &gradient);
    bounds.to_free(u, gradient);
    return value;
  };
  if (options.method == FitMethod::rprop) return optim::maximise_rprop(free_objective, start, options.rprop).stop;
  const Vector infinite = Vector::Constant(start.size(), std::numeric_limits<double>::infinity());
  return optim::maximise_lbfgs(free_objective, start, -infinite, infinite, options.lbfgs).stop;
}

void check(const Inputs& inputs, const ConstVectorView& y, const Hyperparameters& start) {
  Violations wrong;
  wrong.require(y.size() == inputs.size(),
                fmt::format("gp targets have {} rows, must be {}, those of the inputs", y.size(), inputs.size()));
  wrong.require(start.inputs() == inputs.dimensions(),
                fmt::format("gp start has {} length scales, must be {}", start.inputs(), inputs.dimensions()));
  wrong.throw_if_any();
}

Fit failure(const Hyperparameters& start, std::string stop, Index evaluations) {
  return {start, kNaN, 0, kNaN, Fit::Status::failed, std::move(stop), evaluations};
}

}  // namespace

Hyperparameters default_start(const Inputs& inputs, const ConstVectorView& y, double scale, const Bounds& bounds) {
  const double size = static_cast<double>(y.size());
  const double deviation = (y.array() - y.mean()).matrix().norm() / std::sqrt(std::max(size - 1, 1.0));
  const double signal = std::max(deviation, 0.1 * y.norm() / std::sqrt(size));
  Vector flat(inputs.dimensions() + 2);
  flat << inputs.spread().array().log().matrix(), std::log(signal), std::log(signal / 10);
  return Hyperparameters::from_flat(SoftBounds(bounds, inputs, scale).clamped(flat));
}

Fit fit(const Inputs& inputs, const ConstVectorView& y, double scale, const Hyperparameters& start,
        const FitOptions& options) {
  check(inputs, y, start);
  if (!start.flat().allFinite()) return failure(start, "the start is not finite", 0);
  thread_local Workspace workspace;
  Objective objective(inputs, y, options.penalties, workspace);
  const SoftBounds bounds(options.bounds, inputs, scale);
  const Vector inside = bounds.clamped(start.flat());
  objective(inside, nullptr);
  objective(default_start(inputs, y, scale, options.bounds).flat(), nullptr);
  const Vector begin = objective.best().evidence.ok() ? objective.best().flat : inside;
  const std::string stop = maximise(objective, bounds, bounds.free(begin), options);

  const Point& best = objective.best();
  if (!best.evidence.ok()) return failure(start, stop, objective.evaluations());
  const bool moved = (best.flat - inside).cwiseAbs().maxCoeff() > 1e-9;
  return {Hyperparameters::from_flat(best.flat),
          best.evidence.value,
          best.penalty,
          best.evidence.jitter,
          moved ? Fit::Status::improved : Fit::Status::unchanged,
          stop,
          objective.evaluations()};
}

}  // namespace rehearse::gp
