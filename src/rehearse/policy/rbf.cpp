#include "rehearse/policy/rbf.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/rbf_kernel.hpp"
#include "rehearse/policy/squash.hpp"

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

class RbfNetwork final : public Rbf, public Describable {
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
    return radial;
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
