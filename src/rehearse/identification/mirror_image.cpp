#include "rehearse/identification/mirror_image.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "rehearse/gp/odd.hpp"

namespace rehearse::identification {
namespace {

constexpr double kImageError = 1e-3;  // of the changes of a state: less is what a simulator's integrator errs by
constexpr double kContradiction = 3;  // standard deviations of the noise, where at most one is expected, and
constexpr double kContradictionOfChanges = 0.01;  // of the changes' deviation: where noise is none, rounding is more
constexpr double kStill = 1e-9;                   // where a state never changes

std::string name_of(Index state, const std::vector<std::string>& names) {
  const auto s = static_cast<std::size_t>(state);
  return s < names.size() ? names[s] : fmt::format("state {}", state + 1);
}

}  // namespace

Vector signs_of_images(const FeatureMap& features, Index actions) {
  Vector signs = Vector::Constant(features.features() + actions, -1);
  Index f = 0;
  for (const StateKind kind : features.kinds()) {
    if (kind == StateKind::angle) signs(f) = 1;
    f += features_of(kind);
  }
  for (std::size_t j = 0; j < features.joints().size(); ++j, f += 2) signs(f) = 1;
  return signs;
}

double nats_for_odd(const dynamics::Residuals& residuals, const dynamics::Residuals::Rows& rows, const Fit& fit) {
  const Vector signs = signs_of_images(residuals.features(), residuals.data().actions.cols());
  double nats = 0;
  for (Index e = 0; e < rows.targets.cols(); ++e) {
    if (residuals.predicted_by_servos(e)) continue;
    const gp::Hyperparameters& kernel = fit.kernels[static_cast<std::size_t>(e)].hyperparameters;
    nats += gp::odd_evidence(*rows.inputs, signs, rows.targets.col(e), kernel).value - fit.log_evidences(e);
  }
  return nats;
}

std::optional<std::string> not_its_image(const dynamics::Residuals& rows, const prior::Prior& prior, const Vector& phi,
                                         const std::vector<std::string>& names) {
  const Dataset& data = rows.data();
  const Dataset images{.states = -data.states, .actions = -data.actions, .changes = -data.changes, .rewards = {}};
  const Matrix errors = rows.targets(&prior, phi) + rows.of(images).targets(&prior, phi);
  for (Index e = 0; e < errors.cols(); ++e) {
    double largest = 0;
    Index both = 0;  // rows where the prior is finite, as at their images
    for (Index i = 0; i < errors.rows(); ++i)
      if (std::isfinite(errors(i, e))) largest = std::max(largest, std::abs(errors(i, e))), ++both;
    if (both == 0) return "mirror is set, but the prior is not finite at the images of the data";
    if (largest > kImageError * rows.scale()(e) + kStill)
      return fmt::format("mirror is set, but the prior is not its own mirror image: the change of {} differs by {:.2g}",
                         name_of(e, names), largest);
  }
  return std::nullopt;
}

std::optional<std::string> contradicts_image(const dynamics::GpModel& model, const dynamics::Residuals& rows,
                                             const Vector& noise, const std::vector<std::string>& names) {
  const Dataset& data = rows.data();
  Matrix mean(data.size(), data.changes.cols());
  model.predict_mean(data.states, data.actions, mean);
  const std::vector<Index> known = dynamics::finite_rows(data.changes - mean);  // of the others the prior failed
  for (Index e = 0; e < noise.size(); ++e) {
    const Vector errors = (data.changes.col(e) - mean.col(e))(known);
    const double error = errors.norm() / std::sqrt(static_cast<double>(errors.size()));
    const double deviation = std::sqrt(noise(e));
    if (error > kContradiction * deviation && error > kContradictionOfChanges * rows.scale()(e))
      return fmt::format("mirror is set, but measured steps contradict it: {} errs by {:.2g} times its noise",
                         name_of(e, names), error / deviation);
  }
  return std::nullopt;
}

}  // namespace rehearse::identification
