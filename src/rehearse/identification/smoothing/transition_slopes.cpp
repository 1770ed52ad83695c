#include "rehearse/identification/smoothing/transition_slopes.hpp"

#include "rehearse/gp/inputs.hpp"

namespace rehearse::identification {
namespace {

constexpr double kStep = 1e-3;

/// The mean change where state d of each row is larger by `by`.
Matrix mean_beside(const dynamics::DynamicsModel& model, const Dataset& rows, Index d, double by) {
  Matrix X = rows.states, mean(X.rows(), X.cols());
  X.col(d).array() += by;
  model.predict_mean(X, rows.actions, mean);
  return mean;
}

}  // namespace

std::vector<Matrix> transition_slopes(const dynamics::DynamicsModel& model, const Dataset& rows) {
  std::vector<Matrix> slopes;
  for (Index d = 0; d < rows.states.cols(); ++d) {
    const double step = kStep * gp::standard_deviation(rows.states.col(d));
    Matrix slope = Matrix::Zero(rows.states.rows(), rows.states.cols());
    if (step > 0) slope = (mean_beside(model, rows, d, step) - mean_beside(model, rows, d, -step)) / (2 * step);
    slope.col(d).array() += 1;
    slopes.push_back(std::move(slope));
  }
  return slopes;
}

}  // namespace rehearse::identification
