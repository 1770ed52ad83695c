#pragma once
// One step as PILCO's propagate writes it: the joint Gaussian of state, features, action and change grows block by
// block, each with its covariance to all before. GPs by the book.

#include <functional>

#include <Eigen/LU>

#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/moments/feature_moments.hpp"
#include "rehearse/moments/squash_moments.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"

namespace rehearse::moments::naive {

struct Gp {
  Matrix X, Y;
  std::vector<gp::Hyperparameters> theta;
  double jitter = -1;  // ≥ 0: only the mean function, and this added to its variances
};

inline Transformed moments(const Gp& gp, const Gaussian& x) {
  const Index n = gp.X.rows(), D = gp.X.cols(), E = gp.Y.cols();
  const Matrix Z = gp.X.rowwise() - x.mean.transpose(), I = Matrix::Identity(D, D);
  Transformed result = Transformed::zero(D, E);
  Matrix beta(n, E), second(E, E);
  std::vector<Matrix> inverse, precision;
  for (Index e = 0; e < E; ++e) {
    const auto& theta = gp.theta[static_cast<std::size_t>(e)];
    const Matrix P = (-2 * theta.log_lengths).array().exp().matrix().asDiagonal();
    Matrix K(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const Vector d = gp.X.row(i) - gp.X.row(j);
        K(i, j) = theta.signal_variance() * std::exp(-0.5 * d.dot(P * d)) + (i == j ? theta.noise_variance() : 0);
      }
    inverse.push_back(K.inverse());
    precision.push_back(P);
    beta.col(e) = K.partialPivLu().solve(gp.Y.col(e));
    const Matrix B = (x.covariance + P.inverse()).inverse();
    const double c = theta.signal_variance() / std::sqrt((x.covariance * P + I).determinant());
    for (Index i = 0; i < n; ++i) {
      const Vector z = Z.row(i);
      const double q = beta(i, e) * c * std::exp(-0.5 * z.dot(B * z));
      result.mean(e) += q;
      result.gain.col(e) += q * (B * z);
    }
  }
  for (Index a = 0; a < E; ++a)
    for (Index b = 0; b < E; ++b) {
      const auto &theta_a = gp.theta[static_cast<std::size_t>(a)], &theta_b = gp.theta[static_cast<std::size_t>(b)];
      const Matrix &A = precision[static_cast<std::size_t>(a)], &B = precision[static_cast<std::size_t>(b)];
      const Matrix R = x.covariance * (A + B) + I, Q = R.partialPivLu().solve(x.covariance) / 2;
      const double scale = theta_a.signal_variance() * theta_b.signal_variance() / std::sqrt(R.determinant());
      double sum = 0, trace = 0;
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const Vector zi = Z.row(i), zj = Z.row(j), v = A * zi + B * zj;
          const double L = scale * std::exp(-0.5 * zi.dot(A * zi) - 0.5 * zj.dot(B * zj) + v.dot(Q * v));
          sum += beta(i, a) * beta(j, b) * L;
          trace += inverse[static_cast<std::size_t>(a)](i, j) * L;
        }
      result.covariance(a, b) = sum - result.mean(a) * result.mean(b);
      if (a == b) result.covariance(a, a) += gp.jitter >= 0 ? gp.jitter : theta_a.signal_variance() - trace;
    }
  return result;
}

/// A Gaussian that grows.
struct Joint {
  Gaussian all;

  Gaussian part(Index first, Index size) const {
    return {all.mean.segment(first, size), all.covariance.block(first, first, size, size)};
  }
  /// Appends f(the part at `first`), whose covariance to everything is through that part.
  void append(Index first, const Transformed& f) {
    const Index n = all.size(), E = f.outputs();
    const Matrix cross = all.covariance.middleCols(first, f.gain.rows()) * f.gain;
    all.mean.conservativeResize(n + E);
    all.mean.tail(E) = f.mean;
    all.covariance.conservativeResize(n + E, n + E);
    all.covariance.topRightCorner(n, E) = cross;
    all.covariance.bottomLeftCorner(E, n) = cross.transpose();
    all.covariance.bottomRightCorner(E, E) = f.covariance;
  }
};

/// The action of a policy before the squash; one action.
struct Preaction {
  std::function<Transformed(const Gaussian& features)> moments;
  Index features;  // the first so many of the state's
  std::vector<Interval> bounds;
};

/// θ in the order of policy/rbf.hpp.
inline Preaction preaction(const policy::RbfOptions& options, const Vector& theta) {
  const Index F = options.scale.size(), n = options.centres;
  const Gp network{.X = theta.segment(F, n * F).reshaped(F, n).transpose() * options.scale.asDiagonal(),
                   .Y = theta.tail(n),
                   .theta = {{.log_lengths = theta.head(F).array() + options.scale.array().log(),
                              .log_signal = 0,
                              .log_noise = std::log(options.noise)}},
                   .jitter = 1e-6};
  return {[network](const Gaussian& features) { return moments(network, features); }, F, options.bounds};
}

/// θ in the order of policy/network.hpp.
inline Preaction preaction(const policy::LinearOptions& options, const Vector& theta) {
  const Vector slopes = options.squash.gain * theta.head(theta.size() - 1).cwiseQuotient(options.scale);
  const double offset = options.squash.gain * theta(theta.size() - 1);
  const auto moments = [=](const Gaussian& x) -> Transformed {
    return {Vector{{slopes.dot(x.mean) + offset}}, Matrix{{slopes.dot(x.covariance * slopes)}}, slopes};
  };
  return {moments, slopes.size(), options.squash.bounds};
}

inline Gaussian propagate(const FeatureMap& features, const Gp& dynamics, const Preaction& policy,
                          const Gaussian& state) {
  const Index dx = state.size(), F = features.features();
  Joint joint{state};
  joint.append(0, FeatureMoments(features)(state));
  Joint with_preaction = joint;  // the action before the squash is no input of the dynamics
  with_preaction.append(dx, policy.moments(joint.part(dx, policy.features)));
  const Transformed squash = SquashMoments(policy.bounds)(with_preaction.part(dx + F, 1));
  with_preaction.append(dx + F, squash);
  const auto kept = [&] {
    std::vector<Index> indices;
    for (Index i = 0; i < dx + F + 2; ++i)
      if (i != dx + F) indices.push_back(i);
    return indices;
  }();
  joint.all = {with_preaction.all.mean(kept), with_preaction.all.covariance(kept, kept)};
  joint.append(dx, moments(dynamics, joint.part(dx, F + 1)));
  Matrix sum = Matrix::Zero(dx, joint.all.size());
  sum.leftCols(dx).setIdentity();
  sum.rightCols(dx).setIdentity();
  return {sum * joint.all.mean, sum * joint.all.covariance * sum.transpose()};
}

}  // namespace rehearse::moments::naive
