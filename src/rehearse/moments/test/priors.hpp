#pragma once
// Priors of three states and two actions: a linear one, and one that bends.

#include "rehearse/moments/make_prior_moments.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments::priors {

inline constexpr Index kStates = 3, kActions = 2, kInputs = 5;

/// dx × n, and dx.
inline const Matrix kSlopes = 0.4 * tools::normals(kStates, kInputs, 11);
inline const Vector kOffset = tools::normals(kStates, 1, 12);

inline Vector bend(const Vector& x) {
  return Vector{{std::sin(x(0)) * x(3) + 0.2 * x(1) * x(1), std::cos(x(0) - x(1)) + 0.3 * x(2) * x(4),
                 std::tanh(x(2) + 0.5 * x(3)) - 0.1 * x(0)}};
}
inline Vector line(const Vector& x) { return kSlopes * x + kOffset; }

/// of: a point of states and actions ↦ change.
inline prior::Prior prior(Vector (*of)(const Vector&)) {
  const auto change = [of](const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
    Vector x(kInputs);
    for (Index i = 0; i < X.rows(); ++i) {
      x << X.row(i).transpose(), U.row(i).transpose();
      dX.row(i) = of(x).transpose();
    }
  };
  return {"plain", system::make_simulator({}, change), {}};
}

inline std::shared_ptr<const PriorMoments> moments(Vector (*of)(const Vector&), Through through) {
  return make_prior_moments(prior(of), {}, kStates, kActions, through);
}

inline Transformed through(const PriorMoments& prior, const Gaussian& x) {
  PriorTape tape;
  Transformed change;
  EXPECT_TRUE(prior.forward(x, tape, change));
  return change;
}

/// Expects the closed form, up to rounding divided by the steps of differences.
inline void expect_exact_of_a_line(Through way) {
  const Gaussian x = tools::random_gaussian(kInputs, 2, 1);
  const Transformed change = through(*moments(line, way), x);
  const Transformed exact = affine_moments(kSlopes, kOffset, x);
  EXPECT_LT((change.mean - exact.mean).norm(), 1e-12);
  EXPECT_LT((change.covariance - exact.covariance).norm(), 1e-10);
  EXPECT_LT((change.gain - exact.gain).norm(), 1e-10);
}

/// The adjoint ignores that the steps of differences are as long as inputs are large.
inline void expect_adjoint(const Gaussian& x, Through way, double tolerance) {
  const auto prior = moments(bend, way);
  const Transformed by = tools::random_adjoint(kInputs, kStates, 5);
  PriorTape tape;
  Transformed change;
  ASSERT_TRUE(prior->forward(x, tape, change));
  ASSERT_TRUE(prior->differentiate({&tape}));
  Gaussian adjoint = Gaussian::zero(kInputs);
  prior->adjoint(x, tape, change, by, adjoint);
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, through(*prior, at)); }, x, adjoint, 1e-2,
                       tolerance);
}

}  // namespace rehearse::moments::priors
