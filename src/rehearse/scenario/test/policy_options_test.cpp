#include "rehearse/scenario/policy_options.hpp"

#include <gtest/gtest.h>

#include "oscillator.hpp"

namespace rehearse::scenario {
namespace {

const Task kTask = oscillator::task({});

std::shared_ptr<const policy::Policy> make(const std::vector<std::pair<std::string, std::string>>& settings) {
  PolicyOptions options;
  for (const auto& [name, text] : settings)
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { options.fields(v); }, name, text)) << name;
  return make_policy(options, kTask, Vector{{1, 2}});
}

TEST(PolicyOptions, NameThePolicyAndItsSize) {
  for (const auto& [name, size, text, parameters] :
       std::vector<std::tuple<std::string, std::string, std::string, Index>>{
           {"mlp", "hidden", "7", 7 * 3 + 8}, {"rbf", "centres", "4", 2 + 4 * 3}, {"linear", "hidden", "7", 3}}) {
    const auto policy = make({{"policy", name}, {size, text}});
    EXPECT_EQ(policy->name(), name);
    EXPECT_EQ(policy->parameters(), parameters) << name;
    EXPECT_EQ(policy->actions(), 1);
  }
}

TEST(PolicyOptions, ActionsHaveTheTasksBoundsAndTheGain) {
  const Matrix Theta{{0, 0, 0.3}}, X{{0, 0}};
  Matrix U(1, 1);
  make({{"policy", "linear"}, {"policy_gain", "2"}})->act(Theta, X, 0, U);
  EXPECT_NEAR(U(0, 0), -0.5 + 1.5 * std::tanh(0.6), 1e-14);
  make({{"policy", "linear"}, {"policy_gain", "2"}, {"policy_squash", "sine"}})->act(Theta, X, 0, U);
  EXPECT_NEAR(U(0, 0), -0.5 + 1.5 * (9 * std::sin(0.6) + std::sin(1.8)) / 8, 1e-14);
}

}  // namespace
}  // namespace rehearse::scenario
