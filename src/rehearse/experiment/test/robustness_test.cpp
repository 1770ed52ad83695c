#include "rehearse/experiment/robustness.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::experiment {
namespace {

Resolved line_with(const std::string& key, const std::string& value) {
  Spec spec = fake::line_spec(1);
  spec.options = {{key, value}};
  return resolve(fake::catalogue(), spec);
}

TEST(Robustness, ChangesOneParameterAtATime) {
  const Learned policy{std::make_shared<fake::LinePolicy>(), Vector{{-2, 0}}};
  const auto all = robustness(line_with, line_with("noise", "0.01"), policy, {.episodes = 10}, serial_evaluator());
  ASSERT_EQ(all.size(), kFactors.size()) << "the gain alone";
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].parameter, "gain");
    EXPECT_EQ(all[i].value, kFactors[i]);
    EXPECT_EQ(all[i].summary.returns.size(), 10u);
    const double before = all[i > 0 ? i - 1 : 0].summary.returns[0];
    EXPECT_TRUE(i == 0 || all[i].summary.returns[0] > before) << "a faster cart earns more";
  }
  const auto same = evaluate(line_with("noise", "0.01"), policy, {.episodes = 10}, serial_evaluator());
  EXPECT_EQ(all[2].summary.returns, summary_of(same).returns);
}

TEST(Robustness, LeavesOutWhatIsBeyondTheBoundsOfAnOption) {
  const auto bounded = [](const std::string& key, const std::string& value) {
    if (std::stod(value) > 1.2) throw InvalidInput("too large");
    return line_with(key, value);
  };
  const Learned policy{std::make_shared<fake::LinePolicy>(), Vector{{-2, 0}}};
  const auto all = robustness(bounded, line_with("noise", "0.01"), policy, {.episodes = 1}, serial_evaluator());
  ASSERT_EQ(all.size(), kFactors.size() - 1);
  EXPECT_EQ(all.back().factor, 1.125);
}

TEST(Robustness, GoesOnWhereAChangedRobotFails) {
  const auto breaking = [](const std::string& key, const std::string& value) {
    Resolved robot = line_with(key, value);
    if (std::stod(value) > 1.2)
      robot.scenario.make_plant = []() -> std::unique_ptr<system::Plant> { throw std::runtime_error("it broke"); };
    return robot;
  };
  const Learned policy{std::make_shared<fake::LinePolicy>(), Vector{{-2, 0}}};
  const Resolved run = line_with("noise", "0.01");
  const auto all = robustness(breaking, run, policy, {.episodes = 2}, serial_evaluator());
  ASSERT_EQ(all.size(), kFactors.size());
  EXPECT_EQ(all[3].failure, "");
  EXPECT_EQ(all[3].summary.returns.size(), 2u);
  EXPECT_TRUE(all[4].failure.ends_with("it broke")) << all[4].failure;
  const std::string table = robustness_csv(all, {});
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 4) << table;
  EXPECT_EQ(robustness_failures(all), std::vector{all[4].parameter + " 1.25: " + all[4].failure});
  Resolved broken = run;
  broken.scenario.make_plant = breaking("plant.gain", "2").scenario.make_plant;
  EXPECT_THROW(robustness(line_with, broken, policy, {.episodes = 2}, serial_evaluator()), RunFailed);
}

TEST(Robustness, IsATable) {
  Summary summary{.ended = {1, 4, {0, 1}}, .returns = {1, 2, 3, 4, 5}};
  EXPECT_EQ(robustness_csv({{"m", 0.75, 1.5, summary}}, {3, "noise=0.1", 9, 2.4}),
            "trial,settings,seed,seconds,parameter,factor,value,episodes,solved,solved_low,solved_high,solved_at_end,"
            "solved_at_end_low,solved_at_end_high,ended,return_25,return_50,return_75\n"
            "3,noise=0.1,9,2.4,m,0.75,1.5,4,,,,,,,0.25,2,3,4\n");
}

TEST(Robustness, NeedsAParameter) {
  Resolved none = line_with("noise", "0.01");
  none.spec.options.clear();
  EXPECT_THROW(robustness(line_with, none, Learned{}, EvaluationPlan{}, serial_evaluator()), InvalidInput);
}

}  // namespace
}  // namespace rehearse::experiment
