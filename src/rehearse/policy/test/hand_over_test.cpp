#include "rehearse/policy/hand_over.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/testing/check_policy.hpp"

namespace rehearse::policy {
namespace {

std::shared_ptr<const Policy> network() {
  return make_mlp({fixture::features(), fixture::kScale, 4, {fixture::kBounds, 5, Squash::Shape::tanh}});
}

Matrix actions_of(const Policy& policy, const Matrix& Theta, const Matrix& X) {
  Matrix U(X.rows(), 2);
  policy.act(Theta, X, 0.3, U);
  return U;
}

TEST(HandOver, IsFeedbackNearTheGoalAndThePolicyElsewhere) {
  const auto elsewhere = network();
  const Vector theta = fixture::normals(elsewhere->parameters(), 1, 3);
  const auto policy = make_hand_over(fixture::task(), elsewhere);
  const double turn = 2 * std::numbers::pi;
  const Matrix X{{1, 3, 8}, {2, 3, -8}, {2, 3 - turn, 0}, {9, 3, 0}, {1, 0, 0}};
  const Matrix Theta = to_theta(theta, fixture::hand_over()).transpose().replicate(5, 1);
  const Matrix U = actions_of(*policy, Theta, X), other = actions_of(*elsewhere, theta.transpose().replicate(5, 1), X);
  EXPECT_TRUE(U.row(0).isApprox(Matrix{{0.5, 0.2}}));
  EXPECT_TRUE(U.row(1).isApprox(Matrix{{-0.5, 0.21}}));
  EXPECT_TRUE(U.row(2).isApprox(Matrix{{-0.5, 0.21}})) << "an angle is the same after a turn";
  EXPECT_EQ(U.bottomRows(2), other.bottomRows(2));
}

TEST(HandOver, MayBeTheSameForAllTheta) {
  const auto elsewhere = network();
  const Task task = fixture::task();
  const Matrix Theta = fixture::normals(200, elsewhere->parameters(), 3), X = 3 * fixture::normals(200, 3, 4);
  Matrix all(200, make_hand_over(task, elsewhere)->parameters());
  for (Index i = 0; i < 200; ++i) all.row(i) = to_theta(Theta.row(i).transpose(), fixture::hand_over()).transpose();
  const auto fixed = with_hand_over(task, elsewhere, fixture::hand_over());
  const Matrix U = actions_of(*fixed, Theta, X);
  EXPECT_EQ(fixed->parameters(), elsewhere->parameters());
  EXPECT_EQ(U, actions_of(*make_hand_over(task, elsewhere), all, X));
  const auto near = (U.array() != actions_of(*elsewhere, Theta, X).array()).rowwise().any().count();
  EXPECT_GT(near, 20);
  EXPECT_LT(near, 180);
}

TEST(HandOver, HasExamplesAndBoxOfThePolicyElsewhere) {
  const auto elsewhere = network();
  const auto fixed = with_hand_over(fixture::task(), elsewhere, fixture::hand_over());
  EXPECT_EQ(fixed->box().has_value(), elsewhere->box().has_value());
  EXPECT_EQ(fixed->examples().rows(), elsewhere->examples().rows());
}

TEST(HandOver, SaysWhatItIs) {
  const auto elsewhere = network();
  const Vector theta = to_theta(fixture::normals(elsewhere->parameters(), 1, 3), fixture::hand_over());
  const Description all = describe(*make_hand_over(fixture::task(), elsewhere), theta);
  ASSERT_TRUE(all.near && std::holds_alternative<Layers>(all.form));
  EXPECT_EQ(all.near->action, fixture::hand_over().feedback.action);
  EXPECT_EQ(all.near->state, fixture::hand_over().feedback.state);
  EXPECT_EQ(all.near->gain, fixture::hand_over().feedback.gain);
  EXPECT_EQ(all.near->shape, fixture::hand_over().shape);
  EXPECT_EQ(all.near->angles, (std::vector<bool>{false, true, false}));
}

TEST(HandOver, KeepsTheLawsOfPolicies) {
  const Task task = fixture::task();
  EXPECT_EQ(testing::check_policy(*make_hand_over(task, network()), task), std::vector<std::string>{});
  EXPECT_EQ(testing::check_policy(*with_hand_over(task, network(), fixture::hand_over()), task),
            std::vector<std::string>{});
  HandOver wrong = fixture::hand_over();
  wrong.shape = Matrix::Identity(2, 2);
  EXPECT_THROW(with_hand_over(task, network(), wrong), InvalidInput);
}

}  // namespace
}  // namespace rehearse::policy
