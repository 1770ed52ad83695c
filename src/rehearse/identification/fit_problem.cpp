#include "rehearse/identification/fit_problem.hpp"

#include <cmath>
#include <numbers>

namespace rehearse::identification {

void FitProblem::refit(Fit& fit, const gp::FitOptions& options) const {
  const dynamics::Residuals::Rows rows = residuals.at(prior, fit.phi);
  fit.left_out = rows.left_out;
  fit.score = -kInf;
  if (!rows.inputs) return;
  const auto outputs = static_cast<Index>(fit.kernels.size());
  fit.log_evidences.resize(outputs);
  evaluator.for_each(outputs, [&](Index e) {
    gp::FitStart& kernel = fit.kernels[static_cast<std::size_t>(e)];
    const bool told = residuals.predicted_by_servos(e);  // so its targets are 0, and nothing is to be learned
    if (kernel.hyperparameters.inputs() == 0 || told)
      kernel.hyperparameters =
          gp::default_start(*rows.inputs, rows.targets.col(e), residuals.scale()(e), options.bounds, options.trend);
    fit.log_evidences(e) = 0;
    if (told) return;
    gp::Fit fitted = gp::fit(*rows.inputs, rows.targets.col(e), residuals.scale()(e), kernel, options);
    kernel = {std::move(fitted.hyperparameters), std::move(fitted.inverse_hessian)};
    fit.log_evidences(e) = fitted.log_evidence;
  });
  fit.score = charged_score(fit.log_evidences, fit.left_out);
}

double FitProblem::charged_score(const Vector& log_evidences, Index left_out) const {
  std::vector<double> learned;
  for (Index e = 0; e < log_evidences.size(); ++e) {
    if (residuals.predicted_by_servos(e)) continue;
    const double uninformed =
        -0.5 - std::log(gp::usable_scale(residuals.scale()(e))) - 0.5 * std::log(2 * std::numbers::pi);
    learned.push_back(log_evidences(e) + static_cast<double>(left_out) * uninformed);
  }
  return score_of(Eigen::Map<const Vector>(learned.data(), static_cast<Index>(learned.size())), score);
}

Fit unfitted(const Vector& phi, Index outputs, const std::vector<gp::Hyperparameters>& kernels) {
  Fit fit{.phi = phi, .kernels = std::vector<gp::FitStart>(static_cast<std::size_t>(outputs))};
  for (std::size_t e = 0; e < kernels.size(); ++e) fit.kernels[e].hyperparameters = kernels[e];
  return fit;
}

std::vector<gp::Hyperparameters> hyperparameters(const Fit& fit) {
  std::vector<gp::Hyperparameters> kernels;
  for (const gp::FitStart& kernel : fit.kernels) kernels.push_back(kernel.hyperparameters);
  return kernels;
}

}  // namespace rehearse::identification
