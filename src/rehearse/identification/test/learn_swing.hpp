#pragma once
// Models of the swing, learned as `learn` does.

#include <utility>
#include <vector>

#include "rehearse/dynamics/test/swing.hpp"
#include "rehearse/identification/learn.hpp"

namespace rehearse::identification::swing {

using namespace rehearse::swing;  // NOLINT(google-build-using-namespace)

inline Learned learn_swing(const Dataset& data, const Kind& kind, const prior::Prior* prior = nullptr,
                           const WarmStart& start = {}, const Evaluator& evaluator = serial_evaluator()) {
  return learn({data, features(), {}, prior, {}, {"dtheta", "theta"}}, kind, start, evaluator);
}

/// The root mean square error, over rows and outputs, of the changes that a model predicts at the rows of the data.
inline double error(const dynamics::DynamicsModel& model, const Dataset& data) {
  Matrix mean(data.size(), data.states.cols());
  model.predict_mean(data.states, data.actions, mean);
  return rms(mean - data.changes);
}

/// The swing whose simulator fails where the angle is above `limit`.
inline prior::Prior failing_above(double limit, std::vector<Parameter> parameters) {
  return swing::prior(std::move(parameters),
                      [limit](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
                        swing::ode(x, u, phi, dxdt);
                        if (x(1) > limit) dxdt(0) = kNaN;
                      });
}

}  // namespace rehearse::identification::swing
