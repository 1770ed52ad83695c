#include <gtest/gtest.h>

#include "rehearse/moments/expected_return.hpp"
#include "rehearse/moments/make_prior_moments.hpp"
#include "rehearse/robots/cartpole/cartpole.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "returns.hpp"

namespace rehearse::moments {
namespace {

using returns::Problem, returns::random_directions;

StepDynamics around_the_oracle(const scenario::Scenario& scenario, std::shared_ptr<const MomentMatching> gps,
                               Through through) {
  const prior::Prior prior{"oracle", scenario.oracle, scenario.oracle->parameters()};
  return {std::move(gps), make_prior_moments(prior, prior.space.values(), scenario.task.state_size(),
                                             scenario.task.action_size(), through)};
}

// PI-REM: GPs of what a simulator leaves of the changes, and the simulator alone. 50 steps: what the adjoint of a step
// leaves out, the square of the steps of differences, grows with the state's own instability.
TEST(ReturnAroundPrior, GradientAroundASimulatorAgreesWithDifferences) {
  for (const scenario::Scenario& scenario : {robots::cartpole::make({}), robots::pendubot::make({})}) {
    fixture::Data data = fixture::random_data(scenario, 25, true);
    data.changes *= 0.05;
    const auto gps = std::make_shared<const MomentMatching>(
        exact_terms(gp::Posterior(gp::Inputs(data.inputs), data.changes, fixture::plain_hyperparameters(data))), 4);
    for (const Through through : {Through::linearised, Through::unscented})
      for (const auto& around : {gps, std::shared_ptr<const MomentMatching>()}) {
        Problem problem(scenario, 0, 12, around_the_oracle(scenario, around, through));
        const Vector theta = fixture::random_theta(*problem.policy);
        problem.expect_gradient(theta, random_directions(theta.size(), 4), 1e-4, 1e-3);
      }
  }
}

// The Gaussian of a nearly certain start goes where a single rollout goes.
TEST(ReturnAroundPrior, OnASimulatorAloneIsTheReturnOfARollout) {
  const scenario::Scenario scenario = robots::cartpole::make({});
  const auto policy = fixture::rbf(scenario.task, 5);
  const Vector theta = 0.2 * fixture::random_theta(*policy);
  const ExpectedReturn expected(scenario.task, *policy, around_the_oracle(scenario, nullptr, Through::linearised),
                                Gaussian{scenario.task.start_mean, Matrix::Zero(4, 4)});
  ReturnWorkspace workspace;
  const Return result = expected(theta, nullptr, workspace);
  Matrix x = scenario.task.start_mean.transpose(), u(1, 1), dx(1, 4);
  double sum = 0;
  for (Index t = 0; t < scenario.task.horizon; ++t) {
    policy->act(theta.transpose(), x, 0, u);
    scenario.oracle->change(x, u, scenario.oracle->parameters().values(), dx);
    Vector reward(1);
    scenario.task.reward(x, u, x + dx, reward);
    x += dx;
    sum += reward(0);
  }
  EXPECT_NEAR(result.value, sum, 1e-2);
}

}  // namespace
}  // namespace rehearse::moments
