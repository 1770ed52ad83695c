#include "rehearse/dynamics/gp_options.hpp"

#include <gtest/gtest.h>

namespace rehearse::dynamics {
namespace {

TEST(GpOptions, GpsOfManyInputsHaveOneLengthAndNoTrend) {
  gp::FitOptions asked;
  asked.trend = true;
  asked.starts = 7;
  const gp::FitOptions few = fit_options(asked, kFewInputs), many = fit_options(asked, kFewInputs + 1);
  EXPECT_TRUE(few.trend);
  EXPECT_FALSE(few.parsimonious);
  EXPECT_FALSE(many.trend);
  EXPECT_TRUE(many.parsimonious);
  EXPECT_EQ(many.starts, 7) << "the rest is as it was asked for";
}

TEST(GpOptions, AreSetByName) {
  GpOptions options;
  const Fields fields = [&](FieldVisitor& v) { options.fields(v); };
  EXPECT_TRUE(field_violations(fields).empty());
  for (const auto& [name, text] : {std::pair{"trend", "true"}, {"integrate_rates", "true"}, {"variance", "noisy"}})
    EXPECT_TRUE(set_field(fields, name, text)) << name;
  EXPECT_TRUE(options.fit.trend);
  EXPECT_TRUE(options.integrate_rates);
  EXPECT_EQ(options.variance, PredictedVariance::noisy);
}

}  // namespace
}  // namespace rehearse::dynamics
