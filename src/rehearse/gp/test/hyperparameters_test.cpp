#include "rehearse/gp/hyperparameters.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::gp {
namespace {

TEST(Hyperparameters, FlatAndBack) {
  const Hyperparameters theta{.log_lengths = Vector::LinSpaced(3, 1, 3), .log_signal = 4, .log_noise = 5};
  EXPECT_EQ(theta.flat(), Vector(Vector::LinSpaced(5, 1, 5)));
  EXPECT_EQ(Hyperparameters::from_flat(theta.flat(), theta.inputs()).flat(), theta.flat());
  EXPECT_DOUBLE_EQ(theta.signal_variance(), std::exp(8));
  EXPECT_DOUBLE_EQ(theta.noise_variance(), std::exp(10));
  EXPECT_FALSE(theta.has_trend());
}

TEST(Hyperparameters, TheTrendIsLastInFlat) {
  const Hyperparameters theta{
      .log_lengths = Vector{{1, 2}}, .log_signal = 3, .log_noise = 4, .log_trend = Vector{{5, 6, 7}}};
  EXPECT_EQ(theta.flat(), Vector(Vector::LinSpaced(7, 1, 7)));
  EXPECT_EQ(Hyperparameters::from_flat(theta.flat(), 2).log_trend, theta.log_trend);
}

TEST(Hyperparameters, AreOfTheSizesThatThereAre) {
  for (const Index size : {0, 3, 5, 6, 8})
    EXPECT_THROW(Hyperparameters::from_flat(Vector::Zero(size), 2), InvalidInput) << size;
}

TEST(Hyperparameters, EveryViolationIsNamed) {
  Hyperparameters theta{.log_lengths = Vector::Zero(2), .log_signal = 0, .log_noise = 0};
  EXPECT_TRUE(violations(theta, 2, "gp").empty());
  theta.log_lengths(1) = kInf;
  theta.log_noise = kNaN;
  const auto lines = violations(theta, 3, "gp");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "gp.log_lengths has 2 values, must be 3");
  EXPECT_EQ(lines[1], "gp.log_lengths[1] = inf, must be finite");
  EXPECT_EQ(lines[2], "gp.log_noise = nan, must be finite");
  theta = {.log_lengths = Vector::Zero(2), .log_signal = 0, .log_noise = 0, .log_trend = Vector{{0, NAN}}};
  EXPECT_EQ(violations(theta, 2, "gp"), (std::vector<std::string>{"gp.log_trend has 2 values, must be 3",
                                                                  "gp.log_trend[1] = nan, must be finite"}));
}

}  // namespace
}  // namespace rehearse::gp
