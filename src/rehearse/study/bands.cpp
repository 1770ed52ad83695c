#include "rehearse/study/bands.hpp"

#include <algorithm>
#include <cmath>

#include "rehearse/identification/phi_posterior.hpp"
#include "rehearse/rollout/particles.hpp"
#include "rehearse/statistics/columns.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::study {
namespace {

constexpr double kNone = kNaN;
constexpr double kLeast = 1e-9;  // deviation: that of a model that is certain is 0

/// Mean and deviation of particles in each column, in the rows of a start; NaN if fewer than half are left.
void summarise(const Matrix& particles, Index start, Forecasts::At& at) {
  const Vector means = statistics::column_means(particles), deviations = statistics::column_deviations(particles);
  for (Index s = 0; s < particles.cols(); ++s) {
    const Index finite = particles.col(s).array().isFinite().count();
    const bool enough = 2 * finite >= particles.rows();
    at.predicted(start, s) = enough ? means(s) : kNone;
    at.deviation(start, s) = !enough ? kNone : finite > 1 ? deviations(s) : 0;
  }
}

template <class Visit>
void for_each_compared(const std::vector<Forecasts>& all, std::size_t horizon, Index state, Visit visit) {
  for (const Forecasts& forecasts : all) {
    const Forecasts::At& at = forecasts.at[horizon];
    for (Index i = 0; i < at.predicted.rows(); ++i)
      if (std::isfinite(at.predicted(i, state)) && std::isfinite(at.measured(i, state))) visit(at, i);
  }
}

}  // namespace

Forecasts make_forecasts(const dynamics::DynamicsModel& model, const Episode& log, const Matrix& measured,
                         const ForecastPlan& plan, const Draws& draws) {
  Forecasts result{.horizons = plan.horizons};
  for (Index t = plan.first; t < log.steps(); t += plan.every) result.starts.push_back(t);
  const Index dx = log.states.cols();
  const Vector& noise = model.measurement_std();
  Vector start = plan.start_std.size() > 0 ? plan.start_std : Vector::Zero(dx);
  if (noise.size() > 0) start = (start.array().square() + noise.array().square()).sqrt();
  const Index particles = model.certain() && start.isZero(0) ? 1 : plan.particles;
  const std::vector<Matrix> arrived = rollout::forecast_particles(
      model, log, {result.starts, plan.horizons, particles, start}, draws.key, draws.evaluator);
  const auto starts = static_cast<Index>(result.starts.size());
  for (std::size_t h = 0; h < plan.horizons.size(); ++h) {
    Forecasts::At at{Matrix(starts, dx), Matrix(starts, dx), Matrix::Constant(starts, dx, kNone)};
    for (Index i = 0; i < starts; ++i) {
      const Index end = result.starts[static_cast<std::size_t>(i)] + plan.horizons[h];
      if (end <= log.steps()) at.measured.row(i) = measured.row(end);
      summarise(arrived[h].middleRows(i * particles, particles), i, at);
    }
    if (noise.size() > 0)
      at.deviation = (at.deviation.array().square().rowwise() + noise.array().square().transpose()).sqrt();
    at.deviation = at.deviation.cwiseMax(kLeast);
    result.at.push_back(std::move(at));
  }
  return result;
}

Matrix calibration(const std::vector<Forecasts>& forecasts) {
  if (forecasts.empty()) return {};
  const std::size_t horizons = forecasts.front().horizons.size();
  const Index dx = forecasts.front().at.empty() ? 0 : forecasts.front().at.front().predicted.cols();
  const double another = std::sqrt(1 + 1 / static_cast<double>(forecasts.size()));
  Matrix factors = Matrix::Ones(static_cast<Index>(horizons), dx);
  for (std::size_t h = 0; h < horizons; ++h)
    for (Index s = 0; s < dx; ++s) {
      std::vector<double> ratios;
      for_each_compared(forecasts, h, s, [&](const Forecasts::At& at, Index i) {
        ratios.push_back(std::abs(at.measured(i, s) - at.predicted(i, s)) /
                         (identification::kNormal * at.deviation(i, s)));
      });
      if (!ratios.empty()) factors(static_cast<Index>(h), s) = another * statistics::quantile(ratios, 0.95);
    }
  return factors;
}

void widen(std::vector<Forecasts>& forecasts, const Matrix& deviations) {
  for (Forecasts& of : forecasts)
    for (std::size_t h = 0; h < of.at.size(); ++h) {
      Forecasts::At& at = of.at[h];
      const auto row = static_cast<Index>(h);
      for (Index s = 0; s < at.deviation.cols(); ++s)
        if (std::isfinite(deviations(row, s)))
          at.deviation.col(s) = (at.deviation.col(s).array().square() + deviations(row, s) * deviations(row, s)).sqrt();
    }
}

Accuracy accuracy(const std::vector<Forecasts>& forecasts, const Matrix& calibration) {
  const Index horizons = calibration.rows(), dx = calibration.cols();
  Accuracy result{Matrix::Constant(horizons, dx, kNone), Matrix::Constant(horizons, dx, kNone), {}};
  result.compared.resize(horizons, dx);
  for (Index h = 0; h < horizons; ++h)
    for (Index s = 0; s < dx; ++s) {
      double n = 0, squares = 0, inside = 0;
      for_each_compared(forecasts, static_cast<std::size_t>(h), s, [&](const Forecasts::At& at, Index i) {
        const double error = at.measured(i, s) - at.predicted(i, s);
        n += 1, squares += error * error;
        inside += std::abs(error) <= identification::kNormal * calibration(h, s) * at.deviation(i, s);
      });
      if (n > 0) result.rms(h, s) = std::sqrt(squares / n), result.covered(h, s) = inside / n;
      result.compared(h, s) = static_cast<Index>(n);
    }
  return result;
}

}  // namespace rehearse::study
