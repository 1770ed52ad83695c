#include "rehearse/identification/smoothing/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/integration.hpp"
#include "rehearse/gp/correlations.hpp"
#include "rehearse/identification/coordinates.hpp"
#include "rehearse/identification/smoothing/errors_in_variables.hpp"
#include "rehearse/identification/smoothing/measurement_noise.hpp"
#include "rehearse/identification/smoothing/transition_slopes.hpp"

namespace rehearse::identification {
namespace {

constexpr Index kMostStates = 12;
constexpr int kRounds = 5, kVarianceSteps = 4, kPhiSteps = 4, kHalvings = 8;
constexpr Index kStarts = 5;              // of the kernels' fits, and of their rival's
constexpr double kShare = 0.3;            // of an output's noise is at least measurement noise at first
constexpr double kLeastVariance = 1e-12;  // of measurement noise, as a fraction of the changes'
constexpr double kLargestNoise = 1e3;     // times the changes' variance
constexpr double kTolerance = 0.01;       // of the model whose slopes are looked at (gp::Posterior)

/// The white noise that leaves a function of covariance K as uncertain at the rows as `left`, the sum of its posterior
/// variances there; in [low, high].
double equivalent_noise(const Matrix& K, double left, double low, double high) {
  const Eigen::ArrayXd values =
      Eigen::SelfAdjointEigenSolver<Matrix>(K, Eigen::EigenvaluesOnly).eigenvalues().cwiseMax(0);
  Interval log{std::log(low), std::log(high)};
  for (int i = 0; i < 60; ++i) {
    const double middle = (log.low + log.high) / 2, s = std::exp(middle);
    ((s * values / (values + s)).sum() < left ? log.low : log.high) = middle;
  }
  return std::exp((log.low + log.high) / 2);
}

class Smoother {
 public:
  Smoother(const FitProblem& problem, Fit fit)
      : problem_(problem),
        dx_(problem.residuals.scale().size()),
        steps_(problem.residuals.data(), problem.evaluator),
        estimate_(std::move(fit)),
        white_(problem.residuals.data()),
        white_variances_(noise_variances()) {}

  /// False if a number is not finite.
  bool round(bool moves_phi) {
    if (!linearise()) return false;
    if (!steps_.factorise(noise_variances())) return false;
    if (moves_phi && !move_phi()) return false;
    const Matrix targets = on_path().targets(problem_.prior, estimate_.phi);
    const Vector r = steps_.residuals(targets);
    const Vector least = kLeastVariance * problem_.residuals.scale().cwiseAbs2();
    for (int i = 0; i < kVarianceSteps; ++i) {
      steps_.improve_variances(r, least);
      if (!steps_.factorise(noise_variances())) return false;
    }
    estimate_.score = steps_.log_evidence(r);
    score_of_own_errors_ = score_of_own_errors(r);
    steps_.subtract_errors(r);
    given_ = steps_.given_others(r, noise_variances());
    return std::isfinite(estimate_.score) && std::isfinite(score_of_own_errors_) && steps_.states().allFinite() &&
           given_.residuals.allFinite() && whiten(targets);
  }

  void fit_kernels() {
    const gp::FitOptions options = fit_options();
    for_each_output([&](std::size_t e) {
      const gp::KnownNoise noise(given_.errors[e]);
      gp::FitStart& kernel = estimate_.kernels[e];
      const gp::Fit fit = gp::fit(*inputs_, given_.residuals.col(static_cast<Index>(e)), scale(e),
                                  kernel.hyperparameters, options, &noise);
      if (fit.status != gp::Fit::Status::failed) kernel = {fit.hyperparameters, {}};
    });
  }

  /// True if the measurements are clearly likelier than under a rival, and than if every step had errors of its own.
  bool beats(double rival) const { return estimate_.score > std::max(rival, score_of_own_errors_) + margin(); }

  /// The log evidence of GPs of the measured rows at this φ, fitted like these and from where these are.
  double without_errors() const {
    Fit rival = estimate_;
    problem_.refit(rival, fit_options());
    return rival.log_evidences.sum();
  }

  Smoothed result() && {
    std::vector<gp::Hyperparameters> white = white_kernels();
    estimate_.kernels.clear();
    for (gp::Hyperparameters& kernel : white) estimate_.kernels.push_back({std::move(kernel), {}});
    const Vector std = steps_.variances().cwiseSqrt();
    return {std::move(white_), std::move(estimate_), std, std::move(steps_)};
  }

 private:
  template <class Task>
  void for_each_output(Task task) const {
    problem_.evaluator.for_each(dx_, [&](Index e) { task(static_cast<std::size_t>(e)); });
  }

  const gp::Hyperparameters& kernel(std::size_t e) const { return estimate_.kernels[e].hyperparameters; }
  double scale(std::size_t e) const { return gp::usable_scale(problem_.residuals.scale()(static_cast<Index>(e))); }
  /// The price of a variance a state (Schwarz 1978), nats.
  double margin() const {
    const auto numbers = static_cast<double>(problem_.residuals.data().states.size());
    return static_cast<double>(dx_) / 2 * std::log(numbers);
  }

  gp::FitOptions fit_options() const {
    gp::FitOptions options = problem_.options;
    options.starts = std::max(options.starts, kStarts);
    options.penalties.snr = false;  // σ_n is not all of the noise
    return options;
  }

  dynamics::Residuals on_path() const { return problem_.residuals.of(steps_.path()); }

  Vector noise_variances() const {
    Vector variances(dx_);
    for (Index e = 0; e < dx_; ++e) variances(e) = kernel(static_cast<std::size_t>(e)).noise_variance();
    return variances;
  }

  /// The kernels with the white noise of the rows that GPs learn from.
  std::vector<gp::Hyperparameters> white_kernels() const {
    std::vector<gp::Hyperparameters> kernels = hyperparameters(estimate_);
    for (Index e = 0; e < dx_; ++e) kernels[static_cast<std::size_t>(e)].log_noise = std::log(white_variances_(e)) / 2;
    return kernels;
  }

  /// The current model of the dynamics; none if a row's prior mean is not finite.
  std::optional<dynamics::GpModel> model() const {
    const dynamics::Residuals residuals = problem_.residuals.of(white_);
    const dynamics::Residuals::Rows rows = residuals.at(problem_.prior, estimate_.phi);
    if (rows.left_out > 0) return {};
    std::optional<dynamics::Mean> mean;
    if (problem_.prior) mean = dynamics::Mean{*problem_.prior, estimate_.phi};
    return dynamics::GpModel(residuals.features(), residuals.kinematics(), mean,
                             gp::Posterior(*rows.inputs, rows.targets, white_kernels(), kTolerance),
                             dynamics::PredictedVariance::latent, residuals.midpoint());
  }

  /// Some of what the kernels take for noise is that of measurements.
  void start_variances(const dynamics::GpModel& model) {
    const Vector noise = noise_variances(), std = measurement_std(model, problem_.residuals.data(), noise);
    steps_.set_variances(std.cwiseAbs2().cwiseMax(kShare * noise));
    for (gp::FitStart& start : estimate_.kernels) start.hyperparameters.log_noise += std::log(kShare) / 2;
  }

  bool linearise() {
    const std::optional<dynamics::GpModel> model = this->model();
    if (!model) return false;
    if (steps_.variances().size() == 0) start_variances(*model);
    steps_.move_path();
    const dynamics::Residuals::Rows rows = on_path().at(problem_.prior, estimate_.phi);
    if (rows.left_out > 0) return false;
    inputs_ = rows.inputs;
    before_ = transition_slopes(*model, steps_.path());
    after_.assign(before_.size(), Matrix());
    for (std::size_t d = 0; d < before_.size(); ++d) {
      if (!before_[d].allFinite()) return false;
      before_[d] *= -1;
      after_[d] = Matrix::Zero(steps_.path().size(), dx_);
      after_[d].col(static_cast<Index>(d)).setOnes();
      for (Matrix* errors : {&before_[d], &after_[d]})
        dynamics::subtract_integrals(problem_.residuals.kinematics(), steps_.path().states, true, *errors);
    }
    linearise(steps_);
    return true;
  }

  void linearise(ErrorsInVariables& steps) const {
    const Matrix F = inputs_->values();
    steps.linearise(before_, after_, [&](Index e, Index first, Index count) {
      return gp::covariance(F.middleRows(first, count), kernel(static_cast<std::size_t>(e)));
    });
  }

  /// The log evidence if no two steps shared a measurement.
  double score_of_own_errors(const Vector& r) const {
    ErrorsInVariables own(problem_.residuals.data(), problem_.evaluator, Measurements::own);
    own.set_variances(steps_.variances());
    linearise(own);
    return own.factorise(noise_variances()) ? own.log_evidence(r) : kNaN;
  }

  /// φ by Gauss–Newton steps, halved until they lead down.
  bool move_phi() {
    const prior::Prior& prior = *problem_.prior;
    const dynamics::Residuals residuals = on_path();
    const Coordinates coordinates(prior.space, estimate_.phi);
    const Index q = coordinates.size();
    const auto targets = [&](const Vector& z) { return residuals.targets(&prior, coordinates.phi(z)); };
    Vector z = coordinates.start();
    Matrix at = targets(z);
    Vector w = steps_.whitened(steps_.residuals(at));
    if (!w.allFinite()) return false;
    for (int i = 0; q > 0 && i < kPhiSteps; ++i) {
      const std::vector<Matrix> slopes = identification::slopes(targets, z, at);
      Matrix J(w.size(), q);
      for (Index j = 0; j < q; ++j) J.col(j) = steps_.whitened(steps_.stacked(slopes[static_cast<std::size_t>(j)]));
      const Matrix precision = kBoxPrecision * Matrix::Identity(q, q) + J.transpose() * J;
      Vector step = -precision.llt().solve(J.transpose() * w);
      if (!step.allFinite()) return false;
      bool moved = false;
      for (int halving = 0; halving < kHalvings && !moved; ++halving, step /= 2) {
        const Vector next_z = (z + step).cwiseMax(0).cwiseMin(1);
        const Matrix next_at = targets(next_z);
        const Vector next_w = steps_.whitened(steps_.residuals(next_at));
        if (next_w.squaredNorm() < w.squaredNorm()) z = next_z, at = next_at, w = next_w, moved = true;
      }
      if (!moved) break;
    }
    estimate_.phi = coordinates.phi(z);
    return true;
  }

  /// The rows as GPs with white noise may learn from them; `on_path`: the residuals there.
  bool whiten(const Matrix& on_path) {
    const Matrix F = inputs_->values();
    Matrix targets(F.rows(), dx_);
    for_each_output([&](std::size_t e) {
      const auto column = static_cast<Index>(e);
      const double noise = kernel(e).noise_variance();
      const Matrix K = gp::covariance(F, kernel(e));
      Matrix C = K + given_.errors[e];
      C.diagonal().array() += noise;
      const Eigen::LLT<Matrix> factor = C.llt();
      white_variances_(column) = kNaN;
      if (factor.info() != Eigen::Success) return;
      const Vector weights = factor.solve(given_.residuals.col(column));
      const double left = K.trace() - factor.matrixL().solve(K).squaredNorm();
      double& white = white_variances_(column);
      white = equivalent_noise(K, left, noise, kLargestNoise * scale(e) * scale(e));
      targets.col(column) = K * weights + white * weights;
    });
    white_ = steps_.path();
    targets -= on_path;
    dynamics::add_integrals(problem_.residuals.kinematics(), white_.states, true, targets);
    white_.changes += targets;
    return white_.changes.allFinite() && white_variances_.allFinite();
  }

  const FitProblem& problem_;
  const Index dx_;
  ErrorsInVariables steps_;
  std::vector<Matrix> before_, after_;  // what an error of each state adds to the residuals (ErrorsInVariables)
  Fit estimate_;
  std::shared_ptr<const gp::Inputs> inputs_;  // of the path
  ErrorsInVariables::Given given_;
  Dataset white_;
  Vector white_variances_;
  double score_of_own_errors_ = 0;
};

}  // namespace

std::optional<Smoothed> smooth(const FitProblem& problem, const Fit& fit, bool moves_phi) {
  if (problem.residuals.data().states.cols() > kMostStates || fit.left_out > 0) return {};
  const double measured = fit.log_evidences.sum();
  Smoother smoother(problem, fit);
  for (int i = 0; i < kRounds; ++i) {
    if (i > 0) smoother.fit_kernels();
    if (!smoother.round(moves_phi)) return {};
    if (i > 0 && !smoother.beats(measured)) return {};
  }
  if (!smoother.beats(smoother.without_errors())) return {};
  return std::move(smoother).result();
}

}  // namespace rehearse::identification
