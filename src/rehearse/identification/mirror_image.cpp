#include "rehearse/identification/mirror_image.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/correlations.hpp"

namespace rehearse::identification {
namespace {

constexpr double kImageError = 1e-3;  // of the changes of a state: less is what a simulator's integrator errs by
constexpr double kContradiction = 3;  // standard deviations of the noise, where at most one is expected, and
constexpr double kContradictionOfChanges = 0.01;  // of the changes' deviation: where noise is none, rounding is more
constexpr double kStill = 1e-9;                   // where a state never changes

/// log p(y) + n/2 log 2π of a normal distribution with this covariance; NaN if that is not positive definite.
double log_likelihood(const Matrix& covariance, const ConstVectorView& y) {
  const Eigen::LLT<Matrix> factor(covariance);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  const Matrix& L = factor.matrixLLT();
  return -0.5 * factor.matrixL().solve(y).squaredNorm() - L.diagonal().array().log().sum();
}

}  // namespace

Dataset with_images(const Dataset& data) {
  const auto both = [](const Matrix& rows) {
    Matrix all(2 * rows.rows(), rows.cols());
    all << rows, -rows;
    return all;
  };
  return {.states = both(data.states),
          .actions = both(data.actions),
          .changes = both(data.changes),
          .rewards = data.rewards.replicate(2, 1)};
}

double nats_for_odd(const dynamics::Residuals::Rows& rows, const std::vector<gp::Hyperparameters>& kernels,
                    const std::vector<bool>& wanted) {
  const Index n = rows.targets.rows() / 2;
  const Matrix inputs = rows.inputs->values();
  const Matrix X = inputs.topRows(n), images = inputs.bottomRows(n);
  double nats = 0;
  for (Index e = 0; e < rows.targets.cols(); ++e) {
    if (!wanted[static_cast<std::size_t>(e)]) continue;
    const gp::Hyperparameters& kernel = kernels[static_cast<std::size_t>(e)];
    Matrix any = gp::covariance(X, kernel);
    any.diagonal().array() += kernel.noise_variance();
    const auto y = rows.targets.col(e).head(n);
    nats += log_likelihood(any - gp::covariance(X, images, kernel), y) - log_likelihood(any, y);
  }
  return nats;
}

std::optional<std::string> not_its_image(const dynamics::Residuals& rows, const Matrix& targets) {
  if (targets.rows() != 2 * rows.size()) return std::nullopt;  // rows that are left out have no partner
  const Matrix errors = targets.topRows(rows.size()) + targets.bottomRows(rows.size());
  for (Index e = 0; e < errors.cols(); ++e)
    if (const double largest = errors.col(e).cwiseAbs().maxCoeff(); largest > kImageError * rows.scale()(e) + kStill)
      return fmt::format("mirror is set, but the prior is not its own mirror image: output {} differs by {:.2g}", e,
                         largest);
  return std::nullopt;
}

std::optional<std::string> contradicts_image(const dynamics::GpModel& model, const dynamics::Residuals& rows,
                                             const Vector& noise) {
  const Dataset& data = rows.data();
  Matrix mean(data.size(), data.changes.cols());
  model.predict_mean(data.states, data.actions, mean);
  for (Index e = 0; e < noise.size(); ++e) {
    const double error = (data.changes.col(e) - mean.col(e)).norm() / std::sqrt(static_cast<double>(data.size()));
    const double deviation = std::sqrt(noise(e));
    if (error > kContradiction * deviation && error > kContradictionOfChanges * rows.scale()(e))
      return fmt::format("mirror is set, but measured steps contradict it: output {} errs by {:.2g} times its noise", e,
                         error / deviation);
  }
  return std::nullopt;
}

}  // namespace rehearse::identification
