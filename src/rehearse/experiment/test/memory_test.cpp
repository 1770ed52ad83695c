#include "rehearse/experiment/memory.hpp"

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

const std::string kSizes = "there is not enough memory; the largest sizes that are asked for: ";

/// The robot "line" with sizes of its own, under the name "long" and with a horizon that its file says.
class LongBuilder final : public fake::LineBuilder {
 public:
  explicit LongBuilder(Index horizon) : horizon_(horizon) {}
  std::string name() const override { return "long"; }
  void fields(FieldVisitor& v) override {
    fake::LineBuilder::fields(v);
    v.integer("hidden", hidden_, "hidden units of the network", at_least(1));
    v.number("extra_s", extra_s_, "how much longer episodes are [s]", at_least(0));
  }
  scenario::Scenario build() const override {
    scenario::Scenario scenario = fake::LineBuilder::build();
    scenario.name = "long";
    scenario.task.horizon = horizon_;
    return scenario;
  }

 private:
  Index horizon_, hidden_ = 10;
  double extra_s_ = 0;
};

/// The message for a robot whose file has this horizon.
std::string said_of_long(Index horizon, const std::vector<std::pair<std::string, std::string>>& options = {}) {
  Catalogue catalogue = fake::catalogue();
  catalogue.read_robot = [horizon](std::string_view, const std::string&, const auto&) {
    return [horizon] { return std::make_unique<LongBuilder>(horizon); };
  };
  catalogue = catalogue.with_robot("", "long.toml", "");
  return not_enough_memory(
      catalogue, completed(catalogue, {.scenario = "long", .learner = "echo", .prior = "near", .options = options}));
}

TEST(Memory, NamesTheSizesThatAreMostTimesTheirDefault) {
  EXPECT_EQ(said_of_long(12, {{"hidden", "3000"}, {"evaluations", "123456789"}}),
            kSizes + "scenario.evaluations = 123456789, scenario.hidden = 3000");
  EXPECT_EQ(said_of_long(12, {{"hidden", "3000"}, {"evaluations", "200"}}),
            kSizes + "scenario.hidden = 3000, scenario.evaluations = 200");
  EXPECT_EQ(said_of_long(12, {{"hidden", "5"}, {"evaluations", "2"}}), kSizes + "scenario.evaluations = 2")
      << "less than its default asks for nothing";
}

TEST(Memory, NamesNoOptionThatIsNoSize) {
  EXPECT_EQ(said_of_long(12, {{"search.step", "70000"}, {"plant.gain", "5000"}, {"prior.near.drift", "9000"}}),
            "there is not enough memory, and no size that is asked for is larger than usual");
}

TEST(Memory, NamesTheHorizonOfARobotsFile) {
  EXPECT_EQ(said_of_long(1000000, {{"hidden", "40"}}), kSizes + "horizon = 1000000 of long.toml, scenario.hidden = 40");
}

TEST(Memory, NamesTimesOfManySteps) {
  EXPECT_EQ(said_of_long(12, {{"extra_s", "1000"}}), kSizes + "scenario.extra_s = 1000");  // 10000 steps
  EXPECT_EQ(said_of_long(12, {{"extra_s", "1"}}).find("extra_s"), std::string::npos);
}

TEST(Memory, NamesNoMoreThanThree) {
  EXPECT_EQ(said_of_long(300, {{"hidden", "30"}, {"extra_s", "50"}, {"evaluations", "2"}}),
            kSizes + "scenario.extra_s = 50, scenario.hidden = 30, horizon = 300 of long.toml");
}

}  // namespace
}  // namespace rehearse::experiment
