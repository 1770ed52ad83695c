#pragma once
// Forecasts of a log with bands, and their accuracy.

#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::study {

/// Predictions of the measured states of a log from earlier ones, a row a start; NaN beyond its end or where a
/// prediction failed.
struct Forecasts {
  std::vector<Index> starts, horizons;  // control steps
  struct At {
    Matrix predicted, deviation, measured;  // starts × dx
  };
  std::vector<At> at;  // by horizon
};

/// The starts and horizons of forecasts: from step `first` on, every `every` steps.
struct ForecastPlan {
  Index first = 0, every = 1;
  std::vector<Index> horizons;
  Index particles = 50;
  Vector start_std;  // dx, of the states' uncertainty beside measurement noise; empty: none
};

/// The random numbers of the particles, and what computes them.
struct Draws {
  StreamKey key;
  const Evaluator& evaluator;
};

/// Means and deviations of particles that start from the measured states, with an error of measurement, and carry the
/// model's uncertainty; what is measured in the end (T+1 × dx) has an error, too.
Forecasts make_forecasts(const dynamics::DynamicsModel& model, const Episode& log, const Matrix& measured,
                         const ForecastPlan& plan, const Draws& draws);

/// Factors of the deviations (horizons × dx) by which 95 % bands, ± 1.96 of them, hold 95 % of the measurements in
/// these forecasts, none of which the model may have learned from (Lei 2018: conformal prediction), times √(1 + 1/k),
/// for the variation between k logs and another one. 1 where there is nothing to compare.
Matrix calibration(const std::vector<Forecasts>& forecasts);

/// Adds these deviations (horizons × dx), which the model does not account for, to those of the forecasts.
void widen(std::vector<Forecasts>& forecasts, const Matrix& deviations);

/// The accuracy of forecasts of one log or several, horizons × dx.
struct Accuracy {
  Matrix rms;      // of the errors
  Matrix covered;  // fraction inside the bands
  Eigen::Array<Index, Eigen::Dynamic, Eigen::Dynamic> compared;
};
Accuracy accuracy(const std::vector<Forecasts>& forecasts, const Matrix& calibration);

}  // namespace rehearse::study
