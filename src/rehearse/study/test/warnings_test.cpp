#include "rehearse/study/warnings.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "rehearse/study/summary.hpp"
#include "rehearse/study/tables.hpp"
#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

/// Each sentence stands in a section of the summary and in warnings.csv.
void expect_said(const std::vector<std::string>& lines, const char* kind, const Section& section, const Study& study,
                 const Problem& problem) {
  std::string table;
  for (const auto& [name, text] : csv_files(study, problem))
    if (name == "warnings.csv") table = text;
  for (const std::string& line : lines) {
    EXPECT_TRUE(std::ranges::count(section.notes, line)) << line;
    EXPECT_NE(table.find(line.substr(0, line.find('"'))), std::string::npos) << line << "\n" << table;
    EXPECT_NE(table.find(kind), std::string::npos) << table;
  }
}

TEST(Warnings, AnEncoderWithoutZeroIsOfTheLogs) {
  Case swings;
  swings.options.zeros = "";
  swings.options.beyond = Beyond::nothing;
  const Study study = swings.run();
  ASSERT_FALSE(study.hints.empty());
  const std::vector<std::string> lines = log_warnings(study, swings.task);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0], line_of(study.hints[0], swings.task));
  EXPECT_EQ(summary(study, swings.problem())[0].notes.back(), lines[0]);
  EXPECT_NE(lines[0].find("zeros=q of `identify`"), std::string::npos) << lines[0];
  expect_said(lines, "logs,", summary(study, swings.problem())[0], study, swings.problem());
}

// Parameters follow the noise there, so that one would be best at a bound, for instance, says nothing of the robot.
TEST(Warnings, OfARobotAtRestNothingElseIsSaidThanThatNothingMoves) {
  Case swings;
  swings.logs = {swinging_log(1, 0, 0.002, 0), swinging_log(2, 0, 0.002, 0)};
  swings.held_out.clear();
  swings.options.beyond = Beyond::nothing;
  const Study study = swings.run();
  const std::vector<std::string> lines = parameter_warnings(study, swings.problem());
  EXPECT_EQ(lines, std::vector<std::string>{"nothing moves but by errors of measurement, which the parameters follow"});
  expect_said(lines, "parameters,", summary(study, swings.problem())[1], study, swings.problem());
}

TEST(Warnings, LogsOfUnlikeRobotsDoNotAgree) {
  Case swings;
  swings.options.zeros = "";
  swings.options.beyond = Beyond::nothing;
  swings.logs = {swinging_log(1, 0), swinging_log(2, 0)};
  swings.logs[1].episode.actions *= 0.5;
  const std::vector<std::string> lines = parameter_warnings(swings.run(), swings.problem());
  EXPECT_TRUE(std::ranges::count(lines, "weight: the intervals without one log do not overlap"));
}

TEST(Warnings, ABoundThatIsInTheWayIsNamed) {
  Case swings;
  swings.options.zeros = "";
  swings.options.beyond = Beyond::nothing;
  swings.logs = {swinging_log(1, 0), swinging_log(2, 0), swinging_log(3, 0)};
  EXPECT_EQ(parameter_warnings(swings.run(), swings.problem()), std::vector<std::string>{});
  const ParameterSpace narrow(
      {Parameter::continuous("weight", 4, {1, 4.5}), Parameter::continuous("damping", 1, {0, 2})});
  swings.prior = {"narrow", system::make_simulator(narrow, swing), narrow};
  const Study study = swings.run();
  const std::vector<std::string> lines = parameter_warnings(study, swings.problem());
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(std::ranges::any_of(lines, [](const std::string& line) {
    return line.starts_with("weight") && line.find("bound") != std::string::npos;
  })) << lines[0];
  expect_said(lines, "parameters,", summary(study, swings.problem())[1], study, swings.problem());
}

}  // namespace
}  // namespace rehearse::study
