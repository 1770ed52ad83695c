#include "rehearse/moments/propagation.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/make_prior_moments.hpp"
#include "rehearse/moments/rbf_policy.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"

namespace rehearse::moments {
namespace {

class PropagationTest : public ::testing::Test {
 protected:
  struct Step {
    Gaussian next;
    Transformed features;
    StepTape tape;
  };
  Step step(const Gaussian& state, const StepDynamics& dynamics, const FeatureMoments& features) const {
    Step result;
    result.features = features(state);
    const Propagation propagation(dynamics, policy_, serial_evaluator());
    EXPECT_TRUE(propagation.forward(state, result.features, result.tape, result.next));
    return result;
  }

  Step step(const Gaussian& state, const StepDynamics& dynamics) const { return step(state, dynamics, features_); }
  void expect_linearised(const StepDynamics& dynamics) const;
  void expect_adjoint(const StepDynamics& dynamics, const FeatureMoments& moments, double tolerance = 1e-6) const;
  StepDynamics gps(std::vector<MomentTerm> terms) const { return std::make_shared<const MomentMatching>(terms, 4); }
  std::shared_ptr<const PriorMoments> prior(Through through) const {
    const prior::Prior prior{"oracle", scenario_.oracle, scenario_.oracle->parameters()};
    return make_prior_moments(prior, prior.space.values(), 4, 1, through);
  }
  /// GPs that know the scenario badly, around it.
  StepDynamics around_a_prior(Through through, bool joint_angles = false) const {
    return {fixture::random_dynamics(scenario_, 40, joint_angles), prior(through)};
  }

  scenario::Scenario scenario_ = robots::pendubot::make({});
  gp::Posterior posterior_ = fixture::random_posterior(scenario_, 40);
  std::shared_ptr<const policy::Policy> rbf_ = fixture::rbf(scenario_.task, 10);
  RbfPolicy policy_{*std::get<const policy::RbfOptions*>(*analytic_options(*rbf_)), fixture::random_theta(*rbf_)};
  FeatureMoments features_{scenario_.task.feature_map()};
  Vector mean_{{0.4, -0.3, 2.9, 3.3}};
};

void PropagationTest::expect_linearised(const StepDynamics& dynamics) const {
  Matrix slopes(4, 4);
  for (Index d = 0; d < 4; ++d) {
    const auto moved = [&](double h) {
      return step({mean_ + h * Vector::Unit(4, d), Matrix::Zero(4, 4)}, dynamics).next.mean;
    };
    slopes.col(d) = (moved(1e-5) - moved(-1e-5)) / 2e-5;
  }
  const Matrix covariance = 1e-6 * tools::random_gaussian(4, 1, 1).covariance;
  const Matrix of_action = step({mean_, Matrix::Zero(4, 4)}, dynamics).next.covariance;  // what PILCO adds to it
  const Matrix next = step({mean_, covariance}, dynamics).next.covariance;
  const Matrix expected = slopes * covariance * slopes.transpose();
  EXPECT_LT((next - of_action - expected).norm(), 1e-4 * expected.norm());
  EXPECT_EQ(next, next.transpose());
}

/// The model is certain: this needs every covariance between state, features, action and change.
TEST_F(PropagationTest, OfANearlyKnownStateIsTheLinearisedStep) {
  const StepDynamics sure = gps(mean_terms(exact_terms(posterior_)));
  expect_linearised(sure);
  for (const Through through : {Through::linearised, Through::unscented}) {
    expect_linearised({nullptr, prior(through)});
    expect_linearised({sure.gps, prior(through)});
  }
}

void PropagationTest::expect_adjoint(const StepDynamics& dynamics, const FeatureMoments& moments,
                                     double tolerance) const {
  const Gaussian state{mean_, tools::random_gaussian(4, 0.2, 2).covariance};
  const Gaussian by{tools::normals(4, 1, 3), tools::normals(4, 4, 4)};
  Step taken = step(state, dynamics, moments);
  ASSERT_TRUE(!dynamics.prior || dynamics.prior->differentiate({&taken.tape.prior}));
  Gaussian adjoint = Gaussian::zero(4);
  Transformed features = Transformed::zero(4, taken.features.outputs());
  auto networks = policy_.zero_adjoints();
  Propagation(dynamics, policy_, serial_evaluator())
      .adjoint(state, taken.features, taken.tape, by, {adjoint, features, networks});
  moments.adjoint(state, taken.features, features, adjoint);
  const auto f = [&](const Gaussian& at) {
    const Gaussian next = step(at, dynamics, moments).next;
    return by.mean.dot(next.mean) + by.covariance.cwiseProduct(next.covariance).sum();
  };
  tools::expect_slopes(f, state, adjoint, 1e-3, tolerance);
}

TEST_F(PropagationTest, AdjointAgreesWithDifferences) { expect_adjoint(gps(exact_terms(posterior_)), features_); }

TEST_F(PropagationTest, AdjointWithJointAnglesThatThePolicyDoesNotSeeAgreesWithDifferences) {
  expect_adjoint(fixture::random_dynamics(scenario_, 40, true), FeatureMoments(model_features(scenario_.task, true)));
}

TEST_F(PropagationTest, AdjointAroundAPriorAgreesWithDifferences) {
  const FeatureMoments with_joints(model_features(scenario_.task, true));
  for (const Through through : {Through::linearised, Through::unscented}) {
    expect_adjoint({nullptr, prior(through)}, features_, 1e-4);
    expect_adjoint(around_a_prior(through), features_, 1e-4);
    expect_adjoint(around_a_prior(through, true), with_joints, 1e-4);
  }
}

// The closed form, with C = cov[x̃, Δ] of independent pieces (Saveriano 2017).
TEST_F(PropagationTest, AroundALinearPriorIsTheClosedForm) {
  const Matrix slopes = 0.3 * tools::normals(4, 5, 8);
  const auto change = [=](const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
    dX = X * slopes.leftCols(4).transpose() + U * slopes.rightCols(1).transpose();
  };
  const Gaussian state{mean_, tools::random_gaussian(4, 0.2, 2).covariance};
  const Step alone = step(state, gps(exact_terms(posterior_)));
  const StepTape& t = alone.tape;
  Gaussian joint = Gaussian::zero(5);  // states, action
  joint.mean << state.mean, t.action.mean;
  const Matrix with_action = state.covariance * t.gain.rightCols(1);
  joint.covariance << state.covariance, with_action, with_action.transpose(), t.action.covariance;
  Matrix C(5, 4);
  C << state.covariance * t.gain * t.change.gain, t.inputs.covariance.bottomRows(1) * t.change.gain;
  Matrix A = slopes;
  A.leftCols(4) += Matrix::Identity(4, 4);
  const Matrix covariance = A * joint.covariance * A.transpose() + t.change.covariance + A * C + (A * C).transpose();
  for (const Through through : {Through::linearised, Through::unscented}) {
    const prior::Prior linear{"linear", system::make_simulator({}, change), {}};
    const Gaussian next =
        step(state, {gps(exact_terms(posterior_)).gps, make_prior_moments(linear, {}, 4, 1, through)}).next;
    EXPECT_LT((next.mean - A * joint.mean - t.change.mean).norm(), 1e-10);
    EXPECT_LT((next.covariance - covariance).norm(), 1e-9);
  }
}

TEST_F(PropagationTest, RefusesSizesThatDoNotAgree) {
  const StepDynamics dynamics = gps(exact_terms(posterior_));
  const Propagation propagation(dynamics, policy_, serial_evaluator());
  const Gaussian state{mean_, Matrix::Zero(4, 4)};
  Gaussian next;
  StepTape tape;
  EXPECT_THROW(propagation.forward(Gaussian::zero(3), features_(state), tape, next), InvalidInput);
  EXPECT_THROW(propagation.forward(state, Transformed::zero(4, 5), tape, next), InvalidInput);
  EXPECT_THROW(propagation.forward(state, Transformed::zero(3, 6), tape, next), InvalidInput);
  EXPECT_THROW(propagation.forward({mean_, Matrix::Zero(3, 4)}, features_(state), tape, next), InvalidInput);
  const StepDynamics few =
      gps({{.centres = Matrix::Zero(1, 6), .log_lengths = Vector::Zero(6), .weights = Vector{{1}}}});
  EXPECT_THROW(Propagation(few, policy_, serial_evaluator()), InvalidInput);
  EXPECT_THROW(Propagation({}, policy_, serial_evaluator()), InvalidInput);
  const prior::Prior other{"other", scenario_.oracle, {}};
  const Vector phi = scenario_.oracle->parameters().values();
  for (const auto& [states, actions] : {std::pair<Index, Index>{3, 1}, {4, 2}})
    EXPECT_THROW(Propagation({dynamics.gps, make_prior_moments(other, phi, states, actions, Through::linearised)},
                             policy_, serial_evaluator()),
                 InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
