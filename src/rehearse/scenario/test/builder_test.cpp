#include "rehearse/scenario/builder.hpp"

#include <gtest/gtest.h>

#include "oscillator.hpp"

namespace rehearse::scenario {
namespace {

TEST(Builder, BuildsWithTheOptionsThatWereSet) {
  const auto builder = make_builder("swings", oscillator::make);
  EXPECT_EQ(builder->name(), "oscillator");
  EXPECT_EQ(builder->summary(), "swings");
  EXPECT_EQ(builder->prior_names(), (std::vector<std::string>{"slow", "fast"}));
  EXPECT_EQ(builder->build().task.horizon, 5);
  ASSERT_TRUE(set_field([&](FieldVisitor& v) { builder->fields(v); }, "horizon", "9"));
  EXPECT_EQ(builder->build().task.horizon, 9);
}

}  // namespace
}  // namespace rehearse::scenario
