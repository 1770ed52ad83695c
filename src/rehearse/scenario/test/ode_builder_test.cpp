#include "rehearse/scenario/ode_builder.hpp"

#include <gtest/gtest.h>

#include "oscillator.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::scenario {
namespace {

OdeScenario parts() {
  return {.name = "swing",
          .task = oscillator::task({}),
          .kernel = {.states = 2,
                     .actions = 1,
                     .parameters = 1,
                     .derivative = oscillator::derivative,
                     .change = oscillator::change},
          .plant = oscillator::parameters(3),
          .guesses = {{"slow", oscillator::parameters(2)}}};
}

TEST(OdeBuilder, HasTheNamesOfItsParts) {
  const auto builder = make_ode_builder("swings", parts());
  EXPECT_EQ(builder->name(), "swing");
  EXPECT_EQ(builder->summary(), "swings");
  EXPECT_EQ(builder->prior_names(), (std::vector<std::string>{"slow"}));
}

TEST(OdeBuilder, ParametersOfThePlantAreOptions) {
  const auto builder = make_ode_builder("swings", parts(), {.measurement_noise = 0.1});
  const Fields fields = [&](FieldVisitor& v) { builder->fields(v); };
  for (const auto& [name, text] : {std::pair{"plant.omega", "2.5"}, {"measurement_noise", "0"}, {"policy", "linear"}})
    EXPECT_TRUE(set_field(fields, name, text)) << name;
  const Scenario scenario = builder->build();
  EXPECT_EQ(scenario.oracle->parameters().values(), Vector{{2.5}});
  EXPECT_EQ(scenario.priors[0].parameters.values(), Vector{{2}});
  EXPECT_EQ(scenario.policy->name(), "linear");
  Rng rng({});
  EXPECT_EQ(scenario.make_plant()->reset(rng), scenario.task.start_mean);
}

TEST(OdeBuilder, SaysAtOnceWhatIsWrong) {
  OdeScenario late = parts(), wide = parts();
  late.task.dt_s = 0;
  EXPECT_THROW(make_ode_builder("swings", late), InvalidInput);
  wide.task.states.push_back({"another", "m"});
  EXPECT_THROW(make_ode_builder("swings", wide), InvalidInput);
}

}  // namespace
}  // namespace rehearse::scenario
