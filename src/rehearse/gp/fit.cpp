#include "rehearse/gp/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/spread.hpp"

namespace rehearse::gp {
namespace {

constexpr double kSame = 0.5;          // nats: one optimum, though lengths that hardly matter may differ
constexpr std::size_t kFinalists = 2;  // that climb on all rows for kShortClimb evaluations, before the best goes on
constexpr Index kShortClimb = 12;

struct Point {
  Vector flat;
  Evidence evidence{.value = kNaN, .jitter = kNaN};
  double penalty = 0;
  Matrix inverse_hessian = {};  // as in FitStart
  std::string stop = "";
  double value() const { return evidence.value + penalty; }
};

bool better(const Point& a, const Point& b) { return std::isfinite(a.value()) && !(a.value() <= b.value()); }

constexpr double kNoisierLength = 1, kNoisierNoise = 2;  // how ln ℓ and ln σ_n of the default start move
constexpr Index kTried = 40;  // points tried beside those climbed from; the likeliest are taken
constexpr Interval kTriedLengths{-1, 4}, kTriedNoise{-6, 0};  // ln ℓ in spreads, ln σ_n in σ_f
constexpr double kTriedSignal = 0.5;                          // ln σ_f above that of the default start

/// The i-th of points spread evenly over lengths and noise: optima differ in what inputs matter, which starts with
/// equal lengths do not find.
Vector tried_point(const Vector& standard, Index D, Index i) {
  const Vector t = optim::spread_point(D + 1, i + 1);
  const auto within = [&](Interval range, Index d) { return range.low + (range.high - range.low) * t(d); };
  Vector flat = standard;
  for (Index d = 0; d < D; ++d) flat(d) += within(kTriedLengths, d);
  flat(D) += kTriedSignal;
  flat(D + 1) = flat(D) + within(kTriedNoise, D);
  return flat;
}

/// The objective: the penalised log evidence of one output.
struct Problem {
  Problem(const Inputs& X, const ConstVectorView& targets, double scale, const FitOptions& fit_options,
          const KnownNoise* known_noise = nullptr)
      : inputs(X),
        y(targets),
        options(fit_options),
        noise(known_noise),
        bounds(options.bounds, X, scale),
        standard(default_start(X, targets, scale, options.bounds, options.trend).flat()) {}

  const Inputs& inputs;
  const ConstVectorView y;
  const FitOptions& options;
  const KnownNoise* noise;
  const SoftBounds bounds;
  const Vector standard;  // the default start
  Index evaluations = 0;

  /// At flat log hyperparameters; writes the gradient unless null.
  Point at(const Vector& flat, Vector* gradient = nullptr) {
    thread_local Workspace workspace;
    if (options.before_each) options.before_each();
    ++evaluations;
    const Evidence evidence = gp::evidence(inputs, y, flat, workspace, gradient, noise);
    return {flat, evidence, gp::penalty(inputs, flat, options.penalties, gradient)};
  }

  /// The best point on the way up from `start`, itself included.
  Point maximise(const Point& start, Index most = std::numeric_limits<Index>::max()) {
    Point best = options.isotropic ? Point{start.flat} : start;  // the start may have a length for each input
    const optim::Differentiable objective = [&](const Vector& coordinates, Vector& gradient) {
      const Vector free = options.isotropic ? for_each_input(coordinates) : coordinates;
      const Point point = at(bounds.flat(free), &gradient);
      bounds.to_free(free, gradient);
      if (options.isotropic) gradient = over_inputs(gradient);
      if (better(point, best)) best = point;
      return point.value();
    };
    Matrix inverse_hessian = start.inverse_hessian;
    Vector u = bounds.free(start.flat);
    if (options.isotropic) {
      u = over_inputs(u);
      u(0) /= static_cast<double>(inputs.dimensions());
    }
    optim::BfgsOptions bfgs = options.bfgs;
    optim::RpropOptions rprop = options.rprop;
    bfgs.max_evaluations = std::min(bfgs.max_evaluations, most);
    rprop.max_evaluations = std::min(rprop.max_evaluations, most);
    best.stop = options.method == FitMethod::bfgs ? optim::maximise_bfgs(objective, u, bfgs, &inverse_hessian).stop
                                                  : optim::maximise_rprop(objective, u, rprop).stop;
    best.inverse_hessian = std::move(inverse_hessian);
    return best;
  }

  // Free coordinates of one length for all inputs, in units of their spreads.
  Vector for_each_input(const Vector& coordinates) const {
    const Index D = inputs.dimensions();
    Vector free(D + 2);
    free << Vector::Constant(D, coordinates(0)), coordinates.tail(2);
    return free;
  }
  Vector over_inputs(const Vector& free) const {
    return Vector{{free.head(inputs.dimensions()).sum(), free(free.size() - 2), free(free.size() - 1)}};
  }

  /// The given start, or the default one if that is better.
  Point first_start(const FitStart& start) {
    Point given = at(bounds.clamped(start.hyperparameters.flat()));
    given.inverse_hessian = start.inverse_hessian;
    if (given.flat == standard) return given;
    const Point other = at(standard);
    return better(other, given) ? other : given;
  }

  /// The points that a fit starts from: the first start, a noisier one, and the likeliest of points all over.
  std::vector<Point> starts(const FitStart& start) {
    std::vector<Point> all{first_start(start)};
    if (options.starts < 2) return all;
    Vector noisier = standard;
    noisier.head(inputs.dimensions()).array() += kNoisierLength;
    noisier(inputs.dimensions() + 1) += kNoisierNoise;
    all.push_back({noisier});
    const std::vector<Point> others = likeliest(options.starts - 2);
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }

  std::vector<Point> likeliest(Index count) {
    std::vector<Point> tried;
    for (Index i = 0; count > 0 && i < count + kTried; ++i)
      tried.push_back(at(bounds.clamped(tried_point(standard, inputs.dimensions(), i))));
    std::stable_sort(tried.begin(), tried.end(), better);
    tried.resize(static_cast<std::size_t>(count));
    return tried;
  }
};

Inputs part_of(const Inputs& inputs, Index stride) {
  return Inputs(Matrix(inputs.values()(Eigen::seq(0, inputs.size() - 1, stride), Eigen::all)));
}

/// The start on all rows: the best of the optima of every `stride`th row and of the usual first start, by the evidence
/// of all rows after a short climb.
Point start_by_part(Problem& all, double scale, const FitStart& start, Index stride) {
  const Inputs inputs = part_of(all.inputs, stride);
  const Vector y = all.y(Eigen::seq(0, all.y.size() - 1, stride));
  Problem part(inputs, y, scale, all.options);
  std::vector<Point> points{all.first_start(start)};
  const FitStart part_start{start.hyperparameters, start.inverse_hessian * static_cast<double>(stride)};
  for (const Point& begin : part.starts(part_start)) {
    const Point found = part.maximise(begin);
    Point point = all.at(all.bounds.clamped(found.flat));
    point.inverse_hessian = found.inverse_hessian / static_cast<double>(stride);
    const auto same = [&](const Point& other) { return std::abs(other.value() - point.value()) < kSame; };
    if (std::none_of(points.begin(), points.end(), same)) points.push_back(std::move(point));
  }
  std::stable_sort(points.begin(), points.end(), better);
  points.resize(std::min(points.size(), kFinalists));
  for (Point& point : points) point = all.maximise(point, kShortClimb);
  return *std::min_element(points.begin(), points.end(), better);
}

void check(const Inputs& inputs, const ConstVectorView& y, const Hyperparameters& start, const FitOptions& options,
           const KnownNoise* noise) {
  Violations wrong;
  const bool trend = options.trend;
  wrong.require(y.size() == inputs.size(),
                fmt::format("gp targets have {} rows, must be {}, those of the inputs", y.size(), inputs.size()));
  wrong.require(!noise || noise->size() == inputs.size(),
                fmt::format("gp noise is of {} rows, must be of {}", noise ? noise->size() : 0, inputs.size()));
  wrong.require(start.inputs() == inputs.dimensions(),
                fmt::format("gp start has {} length scales, must be {}", start.inputs(), inputs.dimensions()));
  wrong.require(start.has_trend() == trend, fmt::format("gp start has {} trend, must have {}",
                                                        start.has_trend() ? "a" : "no", trend ? "one" : "none"));
  wrong.require(!trend || !(options.isotropic || options.parsimonious),
                "gp fit has a trend, and one length for all inputs");
  wrong.throw_if_any();
}

constexpr double kNoSignal = 1e-6;  // σ_f of noise alone, in units of σ_n
constexpr double kReach = 0.5;  // one length for all of D inputs is at most so many times √D spreads, half of what
                                // rows are away from their mean: what is learned with it ends where the data do

/// floor: of its standard deviation.
Fit noise_alone(const ConstVectorView& y, double floor, const Hyperparameters& start) {
  const auto n = static_cast<double>(y.size());
  const double variance = std::max(y.squaredNorm() / n, floor * floor);
  Fit fit{.hyperparameters = start, .status = Fit::Status::improved, .stop = "noise is as likely"};
  fit.log_evidence = -0.5 * (n * std::log(2 * std::numbers::pi * variance) + y.squaredNorm() / variance);
  fit.hyperparameters.log_noise = 0.5 * std::log(variance);
  fit.hyperparameters.log_signal = fit.hyperparameters.log_noise + std::log(kNoSignal);
  return fit;
}

Fit failure(const Hyperparameters& start, std::string stop, Index evaluations) {
  return {start, kNaN, 0, kNaN, Fit::Status::failed, std::move(stop), evaluations, {}};
}

}  // namespace

Hyperparameters default_start(const Inputs& inputs, const ConstVectorView& y, double scale, const Bounds& bounds,
                              bool trend) {
  const Index D = inputs.dimensions();
  const double size = static_cast<double>(y.size());
  const double signal = std::max(standard_deviation(y), 0.1 * y.norm() / std::sqrt(size));
  Vector flat(trend ? 2 * D + 3 : D + 2);
  flat.head(D + 2) << inputs.spread().array().log().matrix(), std::log(signal), std::log(signal / 10);
  if (trend) flat.tail(D + 1) << std::log(signal) / 2, std::log(signal / 10) / 2 - inputs.magnitude().array().log();
  return Hyperparameters::from_flat(SoftBounds(bounds, inputs, scale).clamped(flat), D);
}

namespace {

Fit fit_kernel(const Inputs& inputs, const ConstVectorView& y, double scale, const FitStart& start,
               const FitOptions& options, const KnownNoise* noise) {
  Problem problem(inputs, y, scale, options, noise);
  const Vector inside = problem.bounds.clamped(start.hyperparameters.flat());
  const Index rows = options.part_rows,
              stride = !noise && rows > 0 && inputs.size() / 2 >= rows ? inputs.size() / rows : 1;
  std::vector<Point> points =
      stride == 1 ? problem.starts(start) : std::vector{start_by_part(problem, scale, start, stride)};
  for (Point& point : points) point = problem.maximise(point);
  const Point& best = *std::min_element(points.begin(), points.end(), better);
  if (!best.evidence.ok()) return failure(start.hyperparameters, best.stop, problem.evaluations);
  return {Hyperparameters::from_flat(best.flat, inputs.dimensions()),
          best.evidence.value,
          best.penalty,
          best.evidence.jitter,
          (best.flat - inside).cwiseAbs().maxCoeff() > 1e-9 ? Fit::Status::improved : Fit::Status::unchanged,
          best.stop,
          problem.evaluations,
          best.inverse_hessian};
}

Fit fit_parsimoniously(const Inputs& inputs, const ConstVectorView& y, double scale, const FitStart& start,
                       FitOptions options) {
  const double cost = 0.5 * std::log(static_cast<double>(y.size())), D = static_cast<double>(inputs.dimensions());
  const Fit each = fit_kernel(inputs, y, scale, start, options, nullptr);
  if (each.status == Fit::Status::failed) return each;
  options.isotropic = true;
  options.penalties = {};
  options.bounds.max_length = std::min(options.bounds.max_length, kReach * std::sqrt(D));
  const Fit one = fit_kernel(inputs, y, scale, {start.hyperparameters, {}}, options, nullptr);
  const double floor = options.bounds.noise_floor * usable_scale(scale);
  const Fit none = noise_alone(y, floor, start.hyperparameters);
  const double value = each.log_evidence - (D + 1) * cost;
  const double of_one = one.status == Fit::Status::failed ? -kInf : one.log_evidence - 2 * cost;
  if (value > std::max(of_one, none.log_evidence)) return each;
  return of_one > none.log_evidence ? one : none;
}

}  // namespace

Fit fit(const Inputs& inputs, const ConstVectorView& y, double scale, const FitStart& start, const FitOptions& options,
        const KnownNoise* noise) {
  check(inputs, y, start.hyperparameters, options, noise);
  if (!start.hyperparameters.flat().allFinite()) return failure(start.hyperparameters, "the start is not finite", 0);
  if (!y.allFinite()) return failure(start.hyperparameters, "the targets are not finite", 0);
  if (options.parsimonious && !noise) return fit_parsimoniously(inputs, y, scale, start, options);
  return fit_kernel(inputs, y, scale, start, options, noise);
}

Fit fit(const Inputs& inputs, const ConstVectorView& y, const FitOptions& options) {
  const double scale = standard_deviation(y);
  return fit(inputs, y, scale, default_start(inputs, y, scale, options.bounds, options.trend), options);
}

}  // namespace rehearse::gp
