#include "rehearse/moments/expected_return.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "naive.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/fitc.hpp"
#include "rehearse/moments/saturating_moments.hpp"
#include "rehearse/robots/cartpole/cartpole.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "returns.hpp"

namespace rehearse::moments {
namespace {

using returns::Problem, returns::coordinates, returns::random_directions;

double largest_difference(const Matrix& a, const Matrix& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

void expect_plain_formulas(const scenario::Scenario& scenario, const std::shared_ptr<const policy::Policy>& policy,
                           bool joint_angles = false) {
  const Task& task = scenario.task;
  Problem problem(scenario, 0, policy, fixture::random_dynamics(scenario, 30, joint_angles));
  const Vector theta = fixture::random_theta(*policy);
  const naive::Preaction preaction =
      std::visit([&](const auto* options) { return naive::preaction(*options, theta); }, *analytic_options(*policy));
  const Return result = problem.expected(theta, nullptr, problem.workspace);
  const fixture::Data data = fixture::random_data(scenario, 30, joint_angles);
  const naive::Gp dynamics{data.inputs, data.changes, fixture::plain_hyperparameters(data)};
  Gaussian state{task.start_mean, 0.01 * Matrix::Identity(4, 4)};
  for (Index t = 0; t < task.horizon; ++t) {
    state = naive::propagate(model_features(task, joint_angles), dynamics, preaction, state);
    const Gaussian& ours = problem.workspace.states[static_cast<std::size_t>(t + 1)];
    ASSERT_LT(largest_difference(ours.mean, state.mean), 1e-8) << t;
    ASSERT_LT(largest_difference(ours.covariance, state.covariance), 1e-8) << t;
    const Transformed f = FeatureMoments(task.feature_map())(state);
    EXPECT_NEAR(result.rewards(t), saturating_moments(*reward::closed_form(task.reward), {f.mean, f.covariance}).mean,
                1e-8);
  }
}

TEST(ExpectedReturn, IsThatOfPlainFormulas) {
  for (const scenario::Scenario& scenario : {robots::cartpole::make({}), robots::pendubot::make({})}) {
    expect_plain_formulas(scenario, fixture::rbf(scenario.task, 12));
    expect_plain_formulas(scenario, fixture::linear(scenario.task));
  }
}

TEST(ExpectedReturn, IsThatOfPlainFormulasWithJointAngles) {
  const scenario::Scenario pendubot = robots::pendubot::make({});
  ASSERT_EQ(model_features(pendubot.task, true).features(), 8);
  expect_plain_formulas(pendubot, fixture::rbf(pendubot.task, 12), true);
  expect_plain_formulas(pendubot, fixture::linear(pendubot.task), true);
}

TEST(ExpectedReturn, ItsEpisodeHasTheDeviationsOfEveryStep) {
  Problem problem(robots::cartpole::make({}), 30, 12);
  const Vector theta = fixture::random_theta(*problem.policy);
  const Return result = problem.expected(theta, nullptr, problem.workspace);
  const ExpectedEpisode episode = problem.expected.episode(theta);
  const Index T = problem.scenario.task.horizon;
  ASSERT_EQ(episode.states.rows(), T + 1);
  ASSERT_EQ(episode.state_deviations.rows(), T + 1);
  for (Index t = 0; t <= T; ++t) {
    const Gaussian& state = problem.workspace.states[static_cast<std::size_t>(t)];
    EXPECT_EQ(episode.states.row(t), state.mean.transpose());
    EXPECT_TRUE(episode.state_deviations.row(t).cwiseAbs2().transpose().isApprox(state.covariance.diagonal()));
  }
  EXPECT_EQ(episode.rewards.sum(), result.value);
  EXPECT_TRUE(episode.reward_deviations.cwiseAbs2().isApprox(result.variances));
}

// The first step throws the state out of all numbers.
TEST(ExpectedReturn, ItsEpisodeEndsWhereTheMomentsAreLost) {
  MomentTerm wild{.centres = Matrix::Zero(1, 6), .log_lengths = Vector::Constant(6, 9), .weights = Vector{{1e300}}};
  Problem problem(robots::cartpole::make({}), 0, 3, std::make_shared<const MomentMatching>(std::vector{wild}, 4));
  const ExpectedEpisode episode = problem.expected.episode(fixture::random_theta(*problem.policy));
  EXPECT_EQ(episode.states.row(0), problem.scenario.task.start_mean.transpose());
  EXPECT_TRUE(episode.state_deviations.row(0).isApproxToConstant(0.1));
  EXPECT_TRUE(episode.states.bottomRows(problem.scenario.task.horizon).array().isNaN().all());
  EXPECT_TRUE(episode.rewards.array().isNaN().all());
}

TEST(ExpectedReturn, GradientOfTheCartPoleAgreesWithDifferences) {
  Problem cartpole(robots::cartpole::make({}), 40, 10);
  const Vector theta = fixture::random_theta(*cartpole.policy);
  ASSERT_EQ(theta.size(), 65);
  cartpole.expect_gradient(theta, coordinates(65));
  cartpole.expect_gradient(theta, random_directions(65, 5));
}

TEST(ExpectedReturn, GradientOfThePendubotAgreesWithDifferences) {
  for (const Index centres : {50, 200}) {
    Problem pendubot(robots::pendubot::make({}), 30, centres);
    const Vector theta = fixture::random_theta(*pendubot.policy);
    pendubot.expect_gradient(theta, random_directions(theta.size(), 3), 1e-4);
    pendubot.expect_gradient(theta, coordinates(theta.size(), theta.size() / 7), 1e-3);
  }
}

TEST(ExpectedReturn, GradientWithJointAnglesAgreesWithDifferences) {
  const scenario::Scenario scenario = robots::pendubot::make({});
  const auto dynamics = fixture::random_dynamics(scenario, 30, true);
  ASSERT_EQ(dynamics->inputs(), 9);
  for (const auto& policy : {fixture::rbf(scenario.task, 20), fixture::linear(scenario.task)}) {
    Problem problem(scenario, 0, policy, dynamics);
    const Vector theta = fixture::random_theta(*policy);
    problem.expect_gradient(theta, random_directions(theta.size(), 3), 1e-4);
    problem.expect_gradient(theta, coordinates(theta.size(), std::max<Index>(1, theta.size() / 7)));
  }
}

TEST(ExpectedReturn, GradientOfLinearPoliciesAgreesWithDifferences) {
  for (const scenario::Scenario& scenario : {robots::cartpole::make({}), robots::pendubot::make({})}) {
    Problem problem(scenario, 40, fixture::linear(scenario.task));
    const Vector theta = fixture::random_theta(*problem.policy);
    problem.expect_gradient(theta, coordinates(theta.size()), 1e-4);
    problem.expect_gradient(theta, random_directions(theta.size(), 5), 1e-4);
  }
}

TEST(ExpectedReturn, GradientWithFitcAndAPriorMeanAgreesWithDifferences) {
  const scenario::Scenario scenario = robots::cartpole::make({});
  const fixture::Data data = fixture::random_data(scenario, 60);
  const auto hyperparameters = fixture::plain_hyperparameters(data);
  auto terms = fitc_terms(data.inputs, data.changes, data.inputs.topRows(20), hyperparameters);
  const gp::Posterior prior(gp::Inputs(data.inputs.bottomRows(15)), 0.1 * data.changes.bottomRows(15), hyperparameters);
  for (MomentTerm& term : mean_terms(exact_terms(prior))) terms.push_back(std::move(term));
  Problem cartpole(scenario, 0, 5, std::make_shared<const MomentMatching>(std::move(terms), 4));
  const Vector theta = fixture::random_theta(*cartpole.policy);
  cartpole.expect_gradient(theta, random_directions(theta.size(), 5));
}

// PILCO with priors: GPs of what the means of GPs with inducing inputs leave of the changes.
TEST(ExpectedReturn, GradientAroundTheGpsOfAPriorAgreesWithDifferences) {
  for (const scenario::Scenario& scenario : {robots::cartpole::make({}), robots::pendubot::make({})}) {
    const fixture::Data data = fixture::random_data(scenario, 70);
    const auto hyperparameters = fixture::plain_hyperparameters(data);
    const Matrix prior_inputs = data.inputs.topRows(45), inputs = data.inputs.bottomRows(25);
    const auto network =
        mean_terms(fitc_terms(prior_inputs, 0.7 * data.changes.topRows(45), prior_inputs.topRows(20), hyperparameters));
    const Matrix left = data.changes.bottomRows(25) - evaluate_means(network, 4, inputs);
    ASSERT_GT(left.norm(), 0.1 * data.changes.bottomRows(25).norm());
    auto terms = exact_terms(gp::Posterior(gp::Inputs(inputs), left, hyperparameters));
    terms.insert(terms.end(), network.begin(), network.end());
    Problem problem(scenario, 0, 12, std::make_shared<const MomentMatching>(std::move(terms), 4));
    const Vector theta = fixture::random_theta(*problem.policy);
    problem.expect_gradient(theta, random_directions(theta.size(), 4));
    problem.expect_gradient(theta, coordinates(theta.size(), theta.size() / 5));
  }
}

TEST(ExpectedReturn, IsTheSumOfWhatTheStepsGive) {
  Problem cartpole(robots::cartpole::make({}), 40, 10);
  const Return result = cartpole.expected(fixture::random_theta(*cartpole.policy), nullptr, cartpole.workspace);
  EXPECT_EQ(result.rewards.size(), 40);
  EXPECT_EQ(result.steps, 40);
  EXPECT_EQ(result.value, result.rewards.sum());
  EXPECT_TRUE((result.rewards.array() > 0).all() && (result.rewards.array() < 1).all());
  EXPECT_TRUE((result.variances.array() >= 0).all());
}

TEST(ExpectedReturn, IsTheSameForAnyNumberOfThreads) {
  Problem cartpole(robots::cartpole::make({}), 70, 10);
  const Vector theta = fixture::random_theta(*cartpole.policy);
  Vector one, three;
  const double value = cartpole.expected(theta, &one, cartpole.workspace).value;
  const auto threads = make_thread_evaluator(3);
  ReturnWorkspace workspace;
  EXPECT_EQ(cartpole.expected(theta, &three, workspace, *threads).value, value);
  EXPECT_EQ(one, three);
}

void expect_no_nan(const std::shared_ptr<const policy::Policy>& policy) {
  Problem cartpole(robots::cartpole::make({}), 20, policy);
  const Vector theta = fixture::random_theta(*policy);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300, -1e300, 1e20, 1e6, -1e6}) {
    for (Index k = 0; k < theta.size(); k += 3) {
      Vector spoilt = theta, gradient;
      spoilt(k) = bad;
      const Return result = cartpole.expected(spoilt, &gradient, cartpole.workspace);
      ASSERT_EQ(gradient.size(), theta.size());
      if (result.ok()) {
        EXPECT_TRUE(gradient.allFinite()) << bad << " " << k;
      } else {
        EXPECT_TRUE(std::isnan(result.value) && gradient.array().isNaN().all());
      }
      EXPECT_EQ(cartpole.expected(spoilt, nullptr, cartpole.workspace).steps == 40, result.steps == 40);
    }
  }
}

TEST(ExpectedReturn, NoParametersEscapeAsNan) {
  const Task task = robots::cartpole::make({}).task;
  expect_no_nan(fixture::rbf(task, 5));
  expect_no_nan(fixture::linear(task));
}

TEST(ExpectedReturn, RefusesWhatHasNoAnalyticMoments) {
  const scenario::Scenario scenario = robots::cartpole::make({});
  const auto dynamics = fixture::random_dynamics(scenario, 10);
  const auto refusal = [&](const Task& task, const policy::Policy& policy,
                           bool without_dynamics = false) -> std::string {
    try {
      ExpectedReturn(task, policy, without_dynamics ? nullptr : dynamics);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(scenario.task, *fixture::rbf(scenario.task, 3)), "");
  EXPECT_EQ(refusal(scenario.task, *scenario.policy),
            "policy = mlp: its actions have no analytic moments, must be rbf, or linear with a sine as squash");
  Task other = scenario.task;
  other.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView r) {
    r.setZero();
  };
  EXPECT_NE(refusal(other, *fixture::rbf(other, 3)).find("the task's reward has no analytic moments"),
            std::string::npos);
  EXPECT_EQ(refusal(scenario.task, *fixture::rbf(scenario.task, 3), true), "dynamics: there are none");
}

TEST(ExpectedReturn, RefusesSizesThatDoNotAgree) {
  const scenario::Scenario cartpole = robots::cartpole::make({}), pendubot = robots::pendubot::make({});
  const auto refusal = [](const Task& task, const policy::Policy& policy,
                          const std::shared_ptr<const MomentMatching>& dynamics) -> std::string {
    try {
      ExpectedReturn(task, policy, dynamics);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  const auto dynamics = fixture::random_dynamics(pendubot, 10), of_cartpole = fixture::random_dynamics(cartpole, 10);
  const auto policy = fixture::rbf(pendubot.task, 3);
  EXPECT_EQ(refusal(pendubot.task, *policy, of_cartpole),
            "dynamics: 6 inputs and 4 outputs, must be 7 (with joint angles 9) and 4");
  EXPECT_EQ(refusal(pendubot.task, *fixture::rbf(cartpole.task, 3), dynamics),
            "policy = rbf: 5 features and 1 actions, the task has 6 and 1");
  Task other = pendubot.task;
  other.reward = reward::saturating([](const ConstMatrixView&, VectorView d2) { d2.setZero(); }, 1,
                                    reward::ClosedForm{Vector::Zero(8), Matrix::Zero(2, 6)});
  EXPECT_EQ(refusal(other, *policy, dynamics),
            "closed form of the reward: of 8 and 6 features, must be of 6 and finite");
}

}  // namespace
}  // namespace rehearse::moments
