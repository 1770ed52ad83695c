#include "rehearse/gp/hyperparameters.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace rehearse::gp {
namespace {

TEST(Hyperparameters, FlatAndBack) {
  const Hyperparameters theta{.log_lengths = Vector::LinSpaced(3, 1, 3), .log_signal = 4, .log_noise = 5};
  EXPECT_EQ(theta.flat(), Vector(Vector::LinSpaced(5, 1, 5)));
  EXPECT_EQ(Hyperparameters::from_flat(theta.flat()).flat(), theta.flat());
  EXPECT_DOUBLE_EQ(theta.signal_variance(), std::exp(8));
  EXPECT_DOUBLE_EQ(theta.noise_variance(), std::exp(10));
}

TEST(Hyperparameters, EveryViolationIsNamed) {
  Hyperparameters theta{.log_lengths = Vector::Zero(2), .log_signal = 0, .log_noise = 0};
  EXPECT_TRUE(violations(theta, 2, "gp").empty());
  theta.log_lengths(1) = std::numeric_limits<double>::infinity();
  theta.log_noise = std::numeric_limits<double>::quiet_NaN();
  const auto lines = violations(theta, 3, "gp");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "gp.log_lengths has 2 values, must be 3");
  EXPECT_EQ(lines[1], "gp.log_lengths[1] = inf, must be finite");
  EXPECT_EQ(lines[2], "gp.log_noise = nan, must be finite");
}

}  // namespace
}  // namespace rehearse::gp
