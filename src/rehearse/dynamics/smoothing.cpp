#include "rehearse/dynamics/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "rehearse/dynamics/coordinates.hpp"
#include "rehearse/dynamics/errors_in_variables.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/integration.hpp"
#include "rehearse/dynamics/measurement_noise.hpp"
#include "rehearse/dynamics/transition_slopes.hpp"
#include "rehearse/gp/correlations.hpp"
#include "rehearse/gp/evidence.hpp"

namespace rehearse::dynamics {
namespace {

using Factor = Eigen::LLT<Matrix>;

constexpr Index kMostStates = 12, kMostNumbers = 800;  // of these a block's residuals have at most so many
constexpr int kRounds = 5, kVarianceSteps = 4, kPhiSteps = 4, kHalvings = 8;
constexpr Index kStarts = 5;              // of the kernels' fits
constexpr double kShare = 0.3;            // of an output's noise is at least measurement noise at first
constexpr double kLeastVariance = 1e-12;  // of measurement noise, as a fraction of the changes'
constexpr double kLargestNoise = 1e3;     // times the changes' variance
constexpr double kBoxPrecision = 12;      // of a uniform distribution, in units of the box
constexpr double kLikelier = 0.15;        // nats a number measured that smoothing must gain
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

double log_determinant(const Factor& factor) { return 2 * factor.matrixLLT().diagonal().array().log().sum(); }

class Smoother {
 public:
  Smoother(const Estimation& estimation, Estimate estimate)
      : estimation_(estimation),
        measured_(estimation.residuals.data()),
        dx_(measured_.states.cols()),
        blocks_(blocks_of(measured_, std::max<Index>(1, kMostNumbers / dx_))),
        Y_(measurements_of(measured_, blocks_)),
        X_(Y_),
        path_(measured_),
        estimate_(std::move(estimate)),
        white_(measured_),
        white_variances_(noise_variances()) {}

  /// False if a number is not finite.
  bool round(bool moves_phi) {
    if (!linearise() || (moves_phi && !move_phi())) return false;
    const Vector r = stacked(on_path().targets(estimation_.prior, estimate_.phi));
    for (int i = 0; i < kVarianceSteps; ++i)
      if (!improve_variances(r)) return false;
    return subtract_errors(r) && whiten();
  }

  void fit_kernels() {
    gp::FitOptions options = estimation_.fit;
    options.starts = std::max(options.starts, kStarts);
    options.penalties.snr = false;  // σ_n is not all of the noise
    for_each_output([&](std::size_t e) {
      const gp::KnownNoise noise(errors_[e]);
      gp::FitStart& kernel = estimate_.kernels[e];
      const gp::Fit fit = gp::fit(*inputs_, given_others_.col(static_cast<Index>(e)), scale(e),
                                  gp::FitStart{kernel.hyperparameters, {}}, options, &noise);
      if (fit.status != gp::Fit::Status::failed) kernel = {fit.hyperparameters, {}};
    });
  }

  /// The log evidence of what was measured.
  double score() const { return estimate_.score; }

  Smoothed result() && {
    for_each_output(
        [&](std::size_t e) { estimate_.kernels[e].hyperparameters.log_noise = std::log(white_variance(e)) / 2; });
    return {std::move(white_), std::move(estimate_), R_.cwiseSqrt(), std::move(phi_covariance_)};
  }

 private:
  template <class Task>
  void for_each_block(Task task) const {
    estimation_.evaluator.for_each(static_cast<Index>(blocks_.size()),
                                   [&](Index b) { task(static_cast<std::size_t>(b)); });
  }
  template <class Task>
  void for_each_output(Task task) const {
    estimation_.evaluator.for_each(dx_, [&](Index e) { task(static_cast<std::size_t>(e)); });
  }

  const gp::Hyperparameters& kernel(std::size_t e) const { return estimate_.kernels[e].hyperparameters; }
  double scale(std::size_t e) const {
    const double scale = estimation_.residuals.scale()(static_cast<Index>(e));
    return scale > 0 ? scale : 1;  // as gp::SoftBounds
  }
  double& white_variance(std::size_t e) { return white_variances_(static_cast<Index>(e)); }
  Residuals on_path() const { return estimation_.residuals.of(path_); }

  Vector noise_variances() const {
    Vector variances(dx_);
    for (Index e = 0; e < dx_; ++e) variances(e) = kernel(static_cast<std::size_t>(e)).noise_variance();
    return variances;
  }

  /// The residuals of the blocks one after the other, output by output.
  Eigen::Ref<Vector> of(std::size_t b, Vector& r) const {
    return r.segment(dx_ * blocks_[b].first, dx_ * blocks_[b].rows);
  }
  Eigen::Ref<const Vector> of(std::size_t b, const Vector& r) const {
    return r.segment(dx_ * blocks_[b].first, dx_ * blocks_[b].rows);
  }
  auto measurements(std::size_t b) const { return Eigen::seqN(blocks_[b].first_measurement, blocks_[b].measurements); }

  Vector reordered(const Matrix& rows) const {
    Vector r(rows.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      of(b, r) = rows.middleRows(blocks_[b].first, blocks_[b].rows).reshaped();
    return r;
  }

  /// Of residuals on the path, with what the errors of measurements on it add.
  Vector stacked(const Matrix& residuals) const {
    Vector r = reordered(residuals);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Matrix off = Y_(measurements(b), Eigen::all) - X_(measurements(b), Eigen::all);
      of(b, r) += linear_[b].B * off.reshaped();
    }
    return r;
  }

  /// What is believed of the dynamics.
  std::optional<GpModel> model() const {
    const Residuals residuals = estimation_.residuals.of(white_);
    const Residuals::Rows rows = residuals.at(estimation_.prior, estimate_.phi);
    if (rows.left_out > 0) return {};
    std::vector<gp::Hyperparameters> kernels = hyperparameters(estimate_);
    for (Index e = 0; e < dx_; ++e) kernels[static_cast<std::size_t>(e)].log_noise = std::log(white_variances_(e)) / 2;
    std::optional<Mean> mean;
    if (estimation_.prior) mean = Mean{*estimation_.prior, estimate_.phi, residuals.midpoint()};
    return GpModel(residuals.features(), residuals.kinematics(), mean,
                   gp::Posterior(*rows.inputs, rows.targets, kernels, kTolerance), PredictedVariance::latent);
  }

  /// Some of what the kernels take for noise is that of measurements.
  void start_variances(const GpModel& model) {
    const Vector noise = noise_variances();
    R_ = measurement_std(model, measured_, noise).cwiseAbs2().cwiseMax(kShare * noise);
    for (gp::FitStart& start : estimate_.kernels) start.hyperparameters.log_noise += std::log(kShare) / 2;
  }

  bool linearise() {
    const std::optional<GpModel> model = this->model();
    if (!model) return false;
    if (R_.size() == 0) start_variances(*model);
    path_ = path_of(X_, measured_, blocks_);
    const Residuals::Rows rows = on_path().at(estimation_.prior, estimate_.phi);
    if (rows.left_out > 0) return false;
    inputs_ = rows.inputs;
    std::vector<Matrix> before = transition_slopes(*model, path_), after(before.size());
    for (std::size_t d = 0; d < before.size(); ++d) {
      if (!before[d].allFinite()) return false;
      before[d] *= -1;
      after[d] = Matrix::Zero(path_.size(), dx_);
      after[d].col(static_cast<Index>(d)).setOnes();
      for (Matrix* errors : {&before[d], &after[d]})
        subtract_integrals(estimation_.residuals.kinematics(), path_.states, true, *errors);
    }
    const Matrix F = inputs_->values();
    linear_.resize(blocks_.size());
    for_each_block([&](std::size_t b) {
      linear_[b] = {.K = {}, .B = errors_of(blocks_[b], before, after)};
      const Matrix rows_of_b = F.middleRows(blocks_[b].first, blocks_[b].rows);
      for (const gp::FitStart& start : estimate_.kernels)
        linear_[b].K.push_back(gp::covariance(rows_of_b, start.hyperparameters));
    });
    return true;
  }

  std::vector<Factor> factors() const {
    std::vector<Factor> all(blocks_.size());
    const Vector W = noise_variances();
    for_each_block([&](std::size_t b) { all[b] = linear_[b].covariance(R_, W).llt(); });
    return all;
  }

  /// φ by Gauss–Newton steps, halved until they lead down.
  bool move_phi() {
    const prior::Prior& prior = *estimation_.prior;
    const Residuals residuals = on_path();
    const Coordinates coordinates(prior.space, estimate_.phi);
    const Index q = coordinates.size();
    const std::vector<Factor> factors = this->factors();
    const auto whitened = [&](Vector r) {
      for (std::size_t b = 0; b < blocks_.size(); ++b) factors[b].matrixL().solveInPlace(of(b, r));
      return r;
    };
    const auto targets = [&](const Vector& z) { return residuals.targets(&prior, coordinates.phi(z)); };
    Vector z = coordinates.start();
    Matrix at = targets(z);
    Vector w = whitened(stacked(at));
    if (!w.allFinite()) return false;
    for (int i = 0; q > 0 && i < kPhiSteps; ++i) {
      const std::vector<Matrix> slopes = dynamics::slopes(targets, z, at);
      Matrix J(w.size(), q);
      for (Index j = 0; j < q; ++j) J.col(j) = whitened(reordered(slopes[static_cast<std::size_t>(j)]));
      const Matrix precision = kBoxPrecision * Matrix::Identity(q, q) + J.transpose() * J;
      Vector step = -precision.llt().solve(J.transpose() * w);
      if (!step.allFinite()) return false;
      phi_covariance_ = precision.inverse();
      bool moved = false;
      for (int halving = 0; halving < kHalvings && !moved; ++halving, step /= 2) {
        const Vector next_z = (z + step).cwiseMax(0).cwiseMin(1);
        const Matrix next_at = targets(next_z);
        const Vector next_w = whitened(stacked(next_at));
        if (next_w.squaredNorm() < w.squaredNorm()) z = next_z, at = next_at, w = next_w, moved = true;
      }
      if (!moved) break;
    }
    estimate_.phi = coordinates.phi(z);
    phi_covariance_ = coordinates.widths().asDiagonal() * phi_covariance_ * coordinates.widths().asDiagonal();
    return true;
  }

  /// Each variance times the root of what its errors explain over what they would by chance.
  bool improve_variances(const Vector& r) {
    const std::vector<Factor> factors = this->factors();
    std::vector<Matrix> sums(blocks_.size());
    for_each_block([&](std::size_t b) {
      const auto& B = linear_[b].B;
      const Vector explained = (B.transpose() * factors[b].solve(of(b, r))).cwiseAbs2();
      const Matrix inverse = factors[b].solve(Matrix::Identity(B.rows(), B.rows()));
      const Vector chance = B.cwiseProduct(inverse * B).transpose() * Vector::Ones(B.rows());
      sums[b].resize(dx_, 2);
      sums[b] << explained.reshaped(blocks_[b].measurements, dx_).colwise().sum().transpose(),
          chance.reshaped(blocks_[b].measurements, dx_).colwise().sum().transpose();
    });
    Matrix total = Matrix::Zero(dx_, 2);
    for (const Matrix& sum : sums) total += sum;
    R_.array() *= total.col(0).cwiseQuotient(total.col(1)).array().sqrt();
    R_ = R_.cwiseMax(kLeastVariance * estimation_.residuals.scale().cwiseAbs2());
    return R_.allFinite();
  }

  /// The path next time, and what each output's GP learns from: residuals, the other outputs' given.
  bool subtract_errors(const Vector& r) {
    const std::vector<Factor> factors = this->factors();
    given_others_.resize(measured_.size(), dx_);
    errors_.assign(static_cast<std::size_t>(dx_), Matrix::Zero(measured_.size(), measured_.size()));
    Vector evidences(static_cast<Index>(blocks_.size()));
    for_each_block([&](std::size_t b) {
      const Vector mine = of(b, r), weights = factors[b].solve(mine);
      evidences(static_cast<Index>(b)) =
          -(mine.dot(weights) + log_determinant(factors[b]) + static_cast<double>(mine.size()) * gp::kLogTwoPi) / 2;
      const Vector v = repeated(R_, blocks_[b].measurements).cwiseProduct(linear_[b].B.transpose() * weights);
      X_(measurements(b), Eigen::all) = Y_(measurements(b), Eigen::all) - v.reshaped(blocks_[b].measurements, dx_);
      give_others(b, mine);
    });
    estimate_.score = evidences.sum();
    return X_.allFinite() && given_others_.allFinite() && std::isfinite(estimate_.score);
  }

  void give_others(std::size_t b, const Vector& r) {
    const Index rows = blocks_[b].rows, first = blocks_[b].first;
    const Matrix S = linear_[b].covariance_of_errors(R_), C = linear_[b].covariance(R_, noise_variances());
    for (Index e = 0; e < dx_; ++e) {
      std::vector<Index> others;
      for (Index i = 0; i < r.size(); ++i)
        if (i / rows != e) others.push_back(i);
      const auto own = Eigen::seqN(e * rows, rows);
      const Factor factor = Matrix(C(others, others)).llt();
      const Matrix across = factor.matrixL().solve(Matrix(S(others, own)));
      given_others_.col(e).segment(first, rows) =
          r(own) - across.transpose() * factor.matrixL().solve(Vector(r(others)));
      errors_[static_cast<std::size_t>(e)].block(first, first, rows, rows) = S(own, own) - across.transpose() * across;
    }
  }

  /// The rows as GPs with white noise may learn from them.
  bool whiten() {
    const Matrix F = inputs_->values();
    Matrix targets(measured_.size(), dx_);
    for_each_output([&](std::size_t e) {
      const auto column = static_cast<Index>(e);
      const double noise = kernel(e).noise_variance();
      const Matrix K = gp::covariance(F, kernel(e));
      Matrix C = K + errors_[e];
      C.diagonal().array() += noise;
      const Factor factor = C.llt();
      const Vector weights = factor.solve(given_others_.col(column));
      const double left = K.trace() - factor.matrixL().solve(K).squaredNorm();
      white_variance(e) = equivalent_noise(K, left, noise, kLargestNoise * scale(e) * scale(e));
      targets.col(column) = K * weights + white_variance(e) * weights;
    });
    white_ = path_;
    targets -= on_path().targets(estimation_.prior, estimate_.phi);
    add_integrals(estimation_.residuals.kinematics(), path_.states, true, targets);
    white_.changes += targets;
    return white_.changes.allFinite() && white_variances_.allFinite();
  }

  const Estimation& estimation_;
  const Dataset& measured_;
  const Index dx_;
  const std::vector<Block> blocks_;
  const Matrix Y_;  // measurements
  Matrix X_;        // what they were of
  Dataset path_;    // along which all is linear; X of the round before
  Vector R_;        // variances of the measurements' noise
  Estimate estimate_;
  std::vector<ErrorsInVariables> linear_;  // one a block
  std::shared_ptr<const gp::Inputs> inputs_;
  Matrix given_others_;         // rows × dx
  std::vector<Matrix> errors_;  // their covariances, one an output
  Dataset white_;
  Vector white_variances_;
  Matrix phi_covariance_;
};

}  // namespace

std::optional<Smoothed> smooth(const Estimation& estimation, const Estimate& estimate, bool moves_phi) {
  if (estimation.residuals.data().states.cols() > kMostStates || estimate.left_out > 0) return {};
  const double enough =
      estimate.log_evidences.sum() + kLikelier * static_cast<double>(estimation.residuals.data().states.size());
  Smoother smoother(estimation, estimate);
  for (int i = 0; i < kRounds; ++i) {
    if (i > 0) smoother.fit_kernels();
    if (!smoother.round(moves_phi)) return {};
    if (i > 0 && !(smoother.score() > enough)) return {};
  }
  return std::move(smoother).result();
}

}  // namespace rehearse::dynamics
