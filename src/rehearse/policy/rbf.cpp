#include "rehearse/policy/rbf.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/feature_slopes.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/differentiable.hpp"
#include "rehearse/policy/rbf_kernel.hpp"
#include "rehearse/policy/squash.hpp"
#include "rehearse/policy/squash_slope.hpp"

namespace rehearse::policy {
namespace {

void check(const RbfOptions& options) {
  Violations violations;
  const Index features = options.features.features();
  violations.require(options.scale.size() == features && (options.scale.array() > 0).all(),
                     fmt::format("policy scale has {} entries, must have {}, all > 0", options.scale.size(), features));
  violations.require(options.centres >= 1, fmt::format("rbf.centres = {}, must be ≥ 1", options.centres));
  violations.require(options.noise > 0, fmt::format("rbf.noise = {}, must be > 0", options.noise));
  violations.require(!options.bounds.empty(), "policy has no actions");
  violations.throw_if_any();
}

/// (K + σ_n² I)⁻¹ y. In extended precision: where centres are close together weights are large and nearly cancel.
Vector solved_weights(const Matrix& centres, const Vector& lengths, double noise, const Vector& targets) {
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Matrix points = centres * lengths.cwiseInverse().asDiagonal();
  Extended K(points.rows(), points.rows());
  for (Index i = 0; i < points.rows(); ++i)
    for (Index j = 0; j < points.rows(); ++j) {
      const Vector apart = points.row(i) - points.row(j);
      K(i, j) = std::exp(-0.5L * apart.squaredNorm()) + (i == j ? noise * noise : 0);
    }
  const Extended y = targets.cast<long double>();
  return K.llt().solve(y).cast<double>();
}

/// The mean of one action's GP, before the squash, and its derivatives.
struct Mean {
  struct Slopes {
    Matrix inputs, centres;
    Vector log_lengths, targets;
  };

  Mean(const Matrix& of_centres, const Vector& log_lengths, const Vector& targets, double noise)
      : centres(of_centres),
        inverse_lengths((-log_lengths.array().max(-kLargestLogLength).min(kLargestLogLength)).exp()) {
    K = correlations(centres);
    llt.compute(K + noise * noise * Matrix::Identity(K.rows(), K.rows()));
    weights = llt.solve(targets);
  }

  Matrix correlations(const Matrix& X) const {
    Matrix squared = Matrix::Zero(X.rows(), centres.rows());
    for (Index d = 0; d < X.cols(); ++d) squared += (apart(X, d) * inverse_lengths(d)).cwiseAbs2();
    return (-0.5 * squared.array()).exp();
  }

  /// by_mean: of each row; the mean is kᵀ K⁻¹ y, so that ∂K counts with − K⁻¹ (Σ k) (K⁻¹ y)ᵀ.
  Slopes pull_back(const Matrix& X, const Matrix& k, const Vector& by_mean) const {
    const Vector solved = llt.solve(k.transpose() * by_mean);
    const Matrix by_k = (by_mean * weights.transpose()).cwiseProduct(k);
    const Matrix by_K = -(solved * weights.transpose()).cwiseProduct(K);
    Slopes by{Matrix(X.rows(), X.cols()), Matrix(centres.rows(), X.cols()), Vector(X.cols()), solved};
    for (Index d = 0; d < X.cols(); ++d) {
      const double factor = inverse_lengths(d) * inverse_lengths(d);
      const Matrix from_rows = apart(X, d), between = apart(centres, d);
      const Matrix rows = factor * by_k.cwiseProduct(from_rows), pairs = factor * by_K.cwiseProduct(between);
      by.inputs.col(d) = -rows.rowwise().sum();
      by.centres.col(d) = rows.colwise().sum().transpose() + pairs.colwise().sum().transpose() - pairs.rowwise().sum();
      by.log_lengths(d) = rows.cwiseProduct(from_rows).sum() + pairs.cwiseProduct(between).sum();
    }
    return by;
  }

  /// x_d − c_d of each row and centre.
  Matrix apart(const Matrix& X, Index d) const {
    return X.col(d).replicate(1, centres.rows()) - centres.col(d).transpose().replicate(X.rows(), 1);
  }

  Matrix centres, K;
  Vector inverse_lengths, weights;
  Eigen::LLT<Matrix> llt;
};

class RbfNetwork final : public Rbf, public Describable, public Differentiable {
 public:
  explicit RbfNetwork(RbfOptions options)
      : Rbf(std::move(options)),
        inverse_scale_(options_.scale.cwiseInverse()),
        shape_{options_.features.features(), options_.centres, static_cast<Index>(options_.bounds.size()),
               options_.noise},
        squash_{.bounds = options_.bounds, .shape = Squash::Shape::sine} {}

  std::string name() const override { return "rbf"; }
  Index actions() const override { return shape_.actions; }
  Index parameters() const override { return shape_.parameters(); }

  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double, MatrixView U) const override {
    check_sizes(*this, options_.features.states(), Theta, X, U);
    thread_local Matrix inputs;
    const Index rows = X.rows();
    inputs.resize(rows, shape_.inputs);
    options_.features.apply(X, inputs);
    for (Index i = 0; i < shape_.inputs; ++i) inputs.col(i) *= inverse_scale_(i);
    rbf(shape_, Theta.data(), Theta.outerStride(), inputs.data(), rows, U.data(), U.outerStride(), rows);
    squash_.apply(U);
  }

  void pull_back(const ConstVectorView& theta, const ConstMatrixView& X, const ConstMatrixView& by_actions,
                 MatrixView by_states, VectorView by_theta) const override {
    const auto [inputs, centres, actions, noise] = shape_;
    Matrix features(X.rows(), inputs), by_inputs = Matrix::Zero(X.rows(), inputs), squashed(X.rows(), 1);
    options_.features.apply(X, features);
    const Matrix scaled = features * inverse_scale_.asDiagonal();
    const auto places = [actions = actions, inputs = inputs, centres = centres](auto& numbers) {
      return numbers.segment(actions * inputs, centres * inputs).reshaped(inputs, centres).transpose();
    };
    Matrix by_centres = Matrix::Zero(centres, inputs);
    for (Index a = 0; a < actions; ++a) {
      const Index targets = (actions + centres) * inputs + a * centres;
      const Mean mean(places(theta), theta.segment(a * inputs, inputs), theta.segment(targets, centres), noise);
      const Matrix k = mean.correlations(scaled);
      squashed = k * mean.weights;
      squash_slope({.bounds = {options_.bounds[static_cast<std::size_t>(a)]}, .shape = Squash::Shape::sine}, squashed);
      const Vector by_mean = squashed.cwiseProduct(by_actions.col(a));
      const Mean::Slopes by = mean.pull_back(scaled, k, by_mean);
      by_inputs += by.inputs;
      by_centres += by.centres;
      by_theta.segment(a * inputs, inputs) +=
          (theta.segment(a * inputs, inputs).array().abs() < kLargestLogLength).select(by.log_lengths, 0.0);
      by_theta.segment(targets, centres) += by.targets;
    }
    by_theta.segment(actions * inputs, centres * inputs) += by_centres.transpose().reshaped();
    by_inputs *= inverse_scale_.asDiagonal();
    pull_back_features(options_.features, features, by_inputs, by_states);
  }

  Description describe(const ConstVectorView& theta) const override {
    const auto [inputs, centres, actions, noise] = shape_;
    Radial radial{.inputs = inputs_of(options_.features, options_.scale),
                  .centres = theta.segment(actions * inputs, centres * inputs).reshaped(inputs, centres).transpose(),
                  .lengths = Matrix(actions, inputs),
                  .weights = Matrix(actions, centres),
                  .squash = squash_};
    for (Index a = 0; a < actions; ++a) {
      const Vector targets = theta.segment((actions + centres) * inputs + a * centres, centres);
      for (Index i = 0; i < inputs; ++i)
        radial.lengths(a, i) = std::exp(std::clamp(theta(a * inputs + i), -kLargestLogLength, kLargestLogLength));
      radial.weights.row(a) = solved_weights(radial.centres, radial.lengths.row(a), noise, targets).transpose();
    }
    return {std::move(radial)};
  }

 private:
  Vector inverse_scale_;
  RbfShape shape_;
  Squash squash_;
};

}  // namespace

std::shared_ptr<const Policy> make_rbf(RbfOptions options) {
  check(options);
  return std::make_shared<RbfNetwork>(std::move(options));
}

}  // namespace rehearse::policy
