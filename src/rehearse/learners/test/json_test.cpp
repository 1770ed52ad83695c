#include "rehearse/learners/json.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"

namespace rehearse::learners {
namespace {

nlohmann::json through_bytes(const nlohmann::json& j) { return nlohmann::json::from_cbor(nlohmann::json::to_cbor(j)); }

TEST(Json, NumbersComeBackFromBytesToTheBit) {
  const Matrix m{{0.1 + 0.2, -0.0, kInf}, {1e-320, std::numeric_limits<double>::max(), -kInf}};
  const Matrix back = to_matrix(through_bytes(to_json(m)));
  EXPECT_EQ(back, m);
  EXPECT_TRUE(std::signbit(back(0, 1)));
  EXPECT_TRUE(std::isnan(to_vector(through_bytes(to_json(Vector{{std::nan("")}})))(0)));
}

TEST(Json, EmptyMatricesKeepTheirRows) {
  EXPECT_EQ(to_matrix(to_json(Matrix(3, 0))).rows(), 3);
  EXPECT_EQ(to_matrix(to_json(Matrix())).size(), 0);
  EXPECT_TRUE(to_vectors(nlohmann::json::array()).empty());
}

TEST(Json, AnEpisodeComesBackAsItWas) {
  Episode e{.states = Matrix{{1, 2}, {3, 4}}, .true_states = Matrix{{5, 6}, {7, 8}}, .actions = Matrix{{9}}};
  e.rewards = Vector{{0.5}};
  e.charged = -1.5;
  EXPECT_FALSE(to_json(e).contains("episode_reward"));
  e.episode_reward = 0.25;
  e.ended = true;
  EXPECT_FALSE(to_json(e).contains("failure"));
  EXPECT_FALSE(to_json(e).contains("broken_limits"));
  e.broken_limits = {"track"};
  e.failure = "it fell";
  const Episode back = to_episode(through_bytes(to_json(e)));
  EXPECT_EQ(back.states, e.states);
  EXPECT_EQ(back.true_states, e.true_states);
  EXPECT_EQ(back.actions, e.actions);
  EXPECT_EQ(back.rewards, e.rewards);
  EXPECT_EQ(back.charged, -1.5);
  EXPECT_EQ(back.episode_reward, 0.25);
  EXPECT_TRUE(back.ended);
  EXPECT_EQ(back.failure, "it fell");
  EXPECT_EQ(back.broken_limits, e.broken_limits);
}

TEST(Json, WhatIsNoMatrixIsRefused) {
  using nlohmann::json;
  EXPECT_THROW(to_matrix({{"rows", 2}, {"values", {1.0, 2.0, 3.0}}}), InvalidInput);
  EXPECT_THROW(to_matrix({{"rows", 0}, {"values", json::array({1.0})}}), InvalidInput);
  EXPECT_THROW(to_matrix({{"rows", -1}, {"values", json::array({1.0})}}), InvalidInput);
  EXPECT_THROW(to_matrix({{"rows", 1}}), json::exception);
  EXPECT_THROW(to_vector("text"), json::exception);
}

TEST(Json, TheStartOfAFitComesBackWithItsTrends) {
  identification::WarmStart start;
  EXPECT_TRUE(to_warm_start(through_bytes(to_json(start))).kernels.empty());
  const Vector flat = Vector::LinSpaced(9, 0.1, 0.9);  // of three inputs, with a trend
  start.kernels = {gp::Hyperparameters::from_flat(flat, 3)};
  start.phi = Vector{{1, 2}};
  start.odd = true;
  const identification::WarmStart back = to_warm_start(through_bytes(to_json(start)));
  ASSERT_EQ(back.kernels.size(), 1U);
  EXPECT_EQ(back.kernels[0].flat(), flat);
  EXPECT_EQ(back.kernels[0].inputs(), 3);
  EXPECT_EQ(*back.phi, *start.phi);
  EXPECT_TRUE(back.odd);
}

TEST(Json, OlderStatesOfPilcoAreRead) {
  const nlohmann::json before = {{"kernels", nlohmann::json::array({to_json(Vector{{0.1, 0.2, 0.3, 0.4}})})}};
  const identification::WarmStart back = to_warm_start(before);
  ASSERT_EQ(back.kernels.size(), 1U);
  EXPECT_EQ(back.kernels[0].inputs(), 2);
  EXPECT_FALSE(back.phi);
  EXPECT_FALSE(back.odd);
}

}  // namespace
}  // namespace rehearse::learners
