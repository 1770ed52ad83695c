#include "rehearse/study/zeros.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/identification/coordinates.hpp"
#include "rehearse/optim/least_squares.hpp"
#include "rehearse/rollout/particles.hpp"
#include "rehearse/statistics/quantiles.hpp"
#include "rehearse/study/certainty.hpp"

namespace rehearse::study {
namespace {

constexpr double kUsual = 3;  // times the usual error: beyond, errors count by their logarithm
constexpr double kMedianOfNormal = 0.6745;
constexpr double kFailed = 10;  // usual errors, of what cannot be predicted

/// A sum of squares of these grows like the logarithm of the errors far away (Cauchy).
double robust(double error) {
  return std::copysign(kUsual * std::sqrt(std::log1p(error * error / (kUsual * kUsual))), error);
}

class Errors {
 public:
  Errors(const std::vector<Episode>& logs, const ZeroProblem& problem, const Evaluator& evaluator)
      : logs_(logs),
        problem_(problem),
        evaluator_(evaluator),
        coordinates_(problem.prior.space, problem.prior.space.values()) {
    for (const Episode& log : logs) {
      const Index last = log.steps() - problem.horizon, every = std::max<Index>(1, log.steps() / problem.starts);
      starts_.emplace_back();
      for (Index t = 0; t <= last && last >= 0; t += every) starts_.back().push_back(t);
      rows_ += std::ssize(starts_.back());
    }
    if (rows_ == 0)
      throw InvalidInput(fmt::format(
          "no log is longer than the {} control steps that parameters are fitted to (fit_horizon_s)", problem.horizon));
    scale_ = usual(raw(start())) / kMedianOfNormal;
    scale_ = scale_.cwiseMax(1e-9);
  }

  /// z: φ's coordinates, then an offset of each state and log, both fractions of their boxes.
  Index size() const { return coordinates_.size() + std::ssize(problem_.states) * std::ssize(logs_); }
  Vector start() const {
    Vector z = Vector::Constant(size(), 0.5);
    z.head(coordinates_.size()) = coordinates_.start();
    return z;
  }
  Vector phi(const Vector& z) const { return coordinates_.phi(z.head(coordinates_.size())); }
  Matrix offsets(const Vector& z) const {
    Matrix offsets = Matrix::Zero(std::ssize(logs_), logs_.front().states.cols());
    Index i = coordinates_.size();
    for (Index log = 0; log < offsets.rows(); ++log)
      for (const Index state : problem_.states) offsets(log, state) = (2 * z(i++) - 1) * problem_.range;
    return offsets;
  }

  /// All errors over the horizon (starts of all logs × dx).
  Matrix raw(const Vector& z) const {
    const dynamics::SimulatorModel model(problem_.prior, phi(z));
    const Matrix offset = offsets(z);
    Matrix errors(rows_, offset.cols());
    Index row = 0;
    for (std::size_t i = 0; i < logs_.size(); ++i) {
      Episode with_offset;
      if (!problem_.states.empty()) with_offset = moved(logs_[i], offset.row(static_cast<Index>(i)).transpose());
      const Episode& log = problem_.states.empty() ? logs_[i] : with_offset;
      const Matrix arrived =
          rollout::forecast_particles(model, log, {starts_[i], {problem_.horizon}, 1, {}}, {}, evaluator_).front();
      for (Index s = 0; s < arrived.rows(); ++s)
        errors.row(row++) = arrived.row(s) - log.states.row(starts_[i][static_cast<std::size_t>(s)] + problem_.horizon);
    }
    return errors;
  }

  Vector at(const Vector& z) const {
    Matrix errors = raw(z);
    for (Index s = 0; s < errors.cols(); ++s)
      for (double& error : errors.col(s)) error = robust(std::isfinite(error) ? error / scale_(s) : kFailed);
    Vector all(errors.size() + (weight_ > 0 ? z.size() : 0));
    all.head(errors.size()) = errors.reshaped();
    all.tail(all.size() - errors.size()) = weight_ * (z - start()).head(all.size() - errors.size());
    return all;
  }

  /// Errors go on with how far z is from where it starts, in units of the boxes' deviations, as errors of this
  /// inflation count it: what they do not tell stays there.
  void trust_start(double inflation) { weight_ = std::sqrt(identification::kBoxPrecision * inflation); }

  /// The errors of predictions alone.
  FittedSquares fitted(const Vector& z) const {
    const Vector r = at(z);
    const Index count = rows_ * scale_.size();
    return {r.head(count), derivatives(z, r).topRows(count), blocks()};
  }

  Matrix derivatives(const Vector& z, const Vector& r) const {
    const std::vector<Matrix> columns =
        identification::slopes([this](const Vector& other) -> Matrix { return at(other); }, z, r);
    Matrix J(r.size(), z.size());
    for (Index i = 0; i < z.size(); ++i) J.col(i) = columns[static_cast<std::size_t>(i)];
    return J;
  }

  /// The block of each error: stretches of a log, three horizons long.
  std::vector<Index> blocks() const {
    std::vector<Index> of_rows, all;
    Index first = 0;
    for (const std::vector<Index>& starts : starts_) {
      for (const Index start : starts) of_rows.push_back(first + start / (3 * problem_.horizon));
      if (!of_rows.empty()) first = of_rows.back() + 1;
    }
    for (Index s = 0; s < scale_.size(); ++s) all.insert(all.end(), of_rows.begin(), of_rows.end());
    return all;
  }

  /// The median magnitude of each state's errors.
  static Vector usual(const Matrix& errors) {
    Vector medians(errors.cols());
    for (Index s = 0; s < errors.cols(); ++s) {
      std::vector<double> sizes;
      for (const double error : errors.col(s)) sizes.push_back(std::isfinite(error) ? std::abs(error) : INFINITY);
      medians(s) = statistics::median(sizes);
    }
    return medians.array().isFinite().select(medians, 1.0);
  }

 private:
  const std::vector<Episode>& logs_;
  const ZeroProblem& problem_;
  const Evaluator& evaluator_;
  identification::Coordinates coordinates_;
  std::vector<std::vector<Index>> starts_;
  Index rows_ = 0;
  double weight_ = 0;
  Vector scale_;
};

/// The point of the least errors, and the one at which errors and the start count as much as they say.
struct Fitted {
  Vector closest, z;
};

Fitted fit(Errors& errors) {
  const Index n = errors.size();
  if (n == 0) return {errors.start(), errors.start()};
  const optim::SquaresProblem squares{[&](const Vector& z) { return errors.at(z); },
                                      [&](const Vector& z, const Vector& r) { return errors.derivatives(z, r); },
                                      Vector::Zero(n), Vector::Ones(n)};
  const auto least_from = [&](const Vector& start) {
    return optim::minimise_squares(squares, start, {.max_steps = 30, .tolerance = 1e-4}).x;
  };
  const Vector closest = least_from(errors.start());
  errors.trust_start(inflation(errors.fitted(closest)));  // how much errors count is known now
  return {closest, least_from(closest)};
}

}  // namespace

Vector errors_left(const std::vector<Episode>& logs, const ZeroProblem& problem, const Evaluator& evaluator) {
  Errors errors(logs, problem, evaluator);
  return Errors::usual(errors.raw(fit(errors).z));
}

Zeros find_zeros(const std::vector<Episode>& logs, const ZeroProblem& problem, const Evaluator& evaluator) {
  Errors errors(logs, problem, evaluator);
  const auto [closest, z] = fit(errors);
  const Index n = errors.size();
  const Vector phi = errors.phi(z);
  const Matrix left = n > 0 ? covariance(errors.fitted(z)) : Matrix();
  const Vector upwards = Vector::Constant(n, 0.5) + left.diagonal().cwiseSqrt();
  return {phi,
          errors.offsets(z),
          errors.offsets(upwards),
          identification::posterior_of(left, problem.prior.space, phi),
          errors.phi(closest),
          Errors::usual(errors.raw(z))};
}

Episode moved(Episode log, const Vector& offset) {
  log.states.rowwise() += offset.transpose();
  log.true_states.rowwise() += offset.transpose();
  return log;
}

}  // namespace rehearse::study
