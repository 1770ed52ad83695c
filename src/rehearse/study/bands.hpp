#pragma once
// Forecasts of a log with bands, and how far they hold.

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
  Vector start_std;  // dx, of what is not known of the states but of their measurements' noise; empty: nothing
};

/// Means and deviations of particles that start from the measured states, with an error of measurement, and carry the
/// model's uncertainty; what is measured in the end (T+1 × dx) has an error, too.
struct Draws {
  StreamKey key;
  const Evaluator& evaluator;
};
Forecasts make_forecasts(const dynamics::DynamicsModel& model, const Episode& log, const Matrix& measured,
                         const ForecastPlan& plan, const Draws& draws);

/// By how much deviations have to be multiplied (horizons × dx) so that 95 % bands, ± 1.96 of them, hold 95 % of what
/// was measured in these forecasts, none of which the model may have learned from (Lei 2018: conformal prediction), and
/// √(1 + 1/k) times as much, since k logs say only so much of another one. 1 where there is nothing to compare.
Matrix calibration(const std::vector<Forecasts>& forecasts);

/// Adds to the deviations what the model does not know that it does not know: these (horizons × dx).
void widen(std::vector<Forecasts>& forecasts, const Matrix& deviations);

/// How good forecasts of one log or several are, horizons × dx.
struct Accuracy {
  Matrix rms;                   // of the errors
  Matrix covered;               // fraction inside the bands
  std::vector<Index> compared;  // by horizon
};
Accuracy accuracy(const std::vector<Forecasts>& forecasts, const Matrix& calibration);

}  // namespace rehearse::study
