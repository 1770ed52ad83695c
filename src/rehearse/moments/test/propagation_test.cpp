#include "rehearse/moments/propagation.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/moments/analytic_policy.hpp"
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
  Step step(const Gaussian& state, const MomentMatching& dynamics, const FeatureMoments& features) const {
    Step result;
    result.features = features(state);
    const Propagation propagation(dynamics, policy_, serial_evaluator());
    EXPECT_TRUE(propagation.forward(state, result.features, result.tape, result.next));
    return result;
  }

  Step step(const Gaussian& state, const MomentMatching& dynamics) const { return step(state, dynamics, features_); }
  void expect_adjoint(const MomentMatching& dynamics, const FeatureMoments& moments) const;

  scenario::Scenario scenario_ = robots::pendubot::make({});
  gp::Posterior posterior_ = fixture::random_posterior(scenario_, 40);
  std::shared_ptr<const policy::Policy> rbf_ = fixture::rbf(scenario_.task, 10);
  RbfPolicy policy_{*std::get<const policy::RbfOptions*>(*analytic_options(*rbf_)), fixture::random_theta(*rbf_), 0};
  FeatureMoments features_{scenario_.task.feature_map()};
  Vector mean_{{0.4, -0.3, 2.9, 3.3}};
};

/// Of a model that is sure: this needs every covariance between state, features, action and change.
TEST_F(PropagationTest, OfANearlyKnownStateIsTheLinearisedStep) {
  const MomentMatching dynamics(mean_terms(posterior_), 4);
  Matrix slopes(4, 4);
  for (Index d = 0; d < 4; ++d) {
    const auto moved = [&](double h) {
      return step({mean_ + h * Vector::Unit(4, d), Matrix::Zero(4, 4)}, dynamics).next.mean;
    };
    slopes.col(d) = (moved(1e-5) - moved(-1e-5)) / 2e-5;
  }
  const Matrix covariance = 1e-6 * tools::random_gaussian(4, 1, 1).covariance;
  const Matrix next = step({mean_, covariance}, dynamics).next.covariance;
  const Matrix expected = slopes * covariance * slopes.transpose();
  EXPECT_LT((next - expected).norm(), 1e-4 * expected.norm());
  EXPECT_EQ(next, next.transpose());
}

void PropagationTest::expect_adjoint(const MomentMatching& dynamics, const FeatureMoments& moments) const {
  const Gaussian state{mean_, tools::random_gaussian(4, 0.2, 2).covariance};
  const Gaussian by{tools::normals(4, 1, 3), tools::normals(4, 4, 4)};
  const Step taken = step(state, dynamics, moments);
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
  tools::expect_slopes(f, state, adjoint, 1e-3, 1e-6);
}

TEST_F(PropagationTest, AdjointAgreesWithDifferences) {
  expect_adjoint(MomentMatching(exact_terms(posterior_), 4), features_);
}

TEST_F(PropagationTest, AdjointWithJointAnglesThatThePolicyDoesNotSeeAgreesWithDifferences) {
  expect_adjoint(*fixture::random_dynamics(scenario_, 40, true), FeatureMoments(model_features(scenario_.task, true)));
}

TEST_F(PropagationTest, RefusesSizesThatDoNotAgree) {
  const MomentMatching dynamics(exact_terms(posterior_), 4);
  const Propagation propagation(dynamics, policy_, serial_evaluator());
  const Gaussian state{mean_, Matrix::Zero(4, 4)};
  Gaussian next;
  StepTape tape;
  EXPECT_THROW(propagation.forward(Gaussian::zero(3), features_(state), tape, next), InvalidInput);
  EXPECT_THROW(propagation.forward(state, Transformed::zero(4, 5), tape, next), InvalidInput);
  EXPECT_THROW(propagation.forward(state, Transformed::zero(3, 6), tape, next), InvalidInput);
  EXPECT_THROW(propagation.forward({mean_, Matrix::Zero(3, 4)}, features_(state), tape, next), InvalidInput);
  const MomentMatching few({{.centres = Matrix::Zero(1, 6), .log_lengths = Vector::Zero(6), .weights = Vector{{1}}}},
                           4);
  EXPECT_THROW(Propagation(few, policy_, serial_evaluator()), InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
