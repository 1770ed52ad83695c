#include "rehearse/dynamics/estimate.hpp"

#include <cmath>
#include <numbers>

namespace rehearse::dynamics {

void Estimation::refit(Estimate& estimate, const gp::FitOptions& options) const {
  const Residuals::Rows rows = residuals.at(prior, estimate.phi);
  estimate.left_out = rows.left_out;
  estimate.score = -std::numeric_limits<double>::infinity();
  if (!rows.inputs) return;
  const auto outputs = static_cast<Index>(estimate.kernels.size());
  estimate.log_evidences.resize(outputs);
  evaluator.for_each(outputs, [&](Index e) {
    gp::FitStart& kernel = estimate.kernels[static_cast<std::size_t>(e)];
    if (kernel.hyperparameters.inputs() == 0)
      kernel.hyperparameters =
          gp::default_start(*rows.inputs, rows.targets.col(e), residuals.scale()(e), options.bounds, options.trend);
    gp::Fit fit = gp::fit(*rows.inputs, rows.targets.col(e), residuals.scale()(e), kernel, options);
    kernel = {std::move(fit.hyperparameters), std::move(fit.inverse_hessian)};
    estimate.log_evidences(e) = fit.log_evidence;
  });
  estimate.score = charged_score(estimate.log_evidences, estimate.left_out);
}

double Estimation::charged_score(const Vector& log_evidences, Index left_out) const {
  std::vector<double> learned;
  for (Index e = 0; e < log_evidences.size(); ++e) {
    if (residuals.told_by_servos(e)) continue;
    const double uninformed =
        -0.5 - std::log(gp::usable_scale(residuals.scale()(e))) - 0.5 * std::log(2 * std::numbers::pi);
    learned.push_back(log_evidences(e) + static_cast<double>(left_out) * uninformed);
  }
  return score_of(Eigen::Map<const Vector>(learned.data(), static_cast<Index>(learned.size())), score);
}

gp::FitOptions fit_options(const gp::FitOptions& options, Index inputs) {
  gp::FitOptions fit = options;
  if (inputs <= kFewInputs) return fit;
  fit.parsimonious = true;
  fit.trend = false;
  return fit;
}

Estimate unfitted(const Vector& phi, Index outputs, const std::vector<gp::Hyperparameters>& kernels) {
  Estimate estimate{.phi = phi, .kernels = std::vector<gp::FitStart>(static_cast<std::size_t>(outputs))};
  for (std::size_t e = 0; e < kernels.size(); ++e) estimate.kernels[e].hyperparameters = kernels[e];
  return estimate;
}

std::vector<gp::Hyperparameters> hyperparameters(const Estimate& estimate) {
  std::vector<gp::Hyperparameters> kernels;
  for (const gp::FitStart& kernel : estimate.kernels) kernels.push_back(kernel.hyperparameters);
  return kernels;
}

}  // namespace rehearse::dynamics
