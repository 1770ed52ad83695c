#include "rehearse/experiment/study_setup.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

StudySetup set_up(const StudyRequest& request) {
  Violations violations;
  return set_up_study(fake::catalogue(), request, violations);
}

TEST(StudySetup, HasTheRobotAndItsFirstPrior) {
  const StudySetup setup = set_up({.robot = "line", .prior = {}, .settings = {}});
  EXPECT_EQ(setup.scenario.name, "line");
  ASSERT_TRUE(setup.prior);
  EXPECT_EQ(setup.robot.state_size(), setup.scenario.task.state_size());
}

TEST(StudySetup, TakesOptionsOfTheRobotAsASpecWritesThem) {
  const auto evaluations = [](const char* key) {
    return set_up({.robot = "line", .prior = {}, .settings = {{key, "7"}}}).scenario.evaluations;
  };
  EXPECT_EQ(evaluations("evaluations"), 7);
  EXPECT_EQ(evaluations("scenario.evaluations"), 7);
  EXPECT_THROW(evaluations("scenario.rows"), InvalidInput) << "an option of identify alone";
}

TEST(StudySetup, SaysAllThatIsWrong) {
  const std::string said = fake::message_of<InvalidInput>([] {
    set_up({.robot = "line", .prior = "nope", .settings = {{"nois", "1"}, {"rows", "-1"}}});
  });
  for (const char* part : {"nope", "nois", "rows = -1"}) EXPECT_NE(said.find(part), std::string::npos) << said;
  Violations before;
  before.add("threads = 0");
  const std::string unknown = fake::message_of<InvalidInput>(
      [&] { set_up_study(fake::catalogue(), {.robot = "lin", .prior = {}, .settings = {}}, before); });
  for (const char* part : {"threads = 0", "'lin'"}) EXPECT_NE(unknown.find(part), std::string::npos) << unknown;
}

// Eight rows a step, which flicker.
TEST(StudySetup, ForecastsOfLogsAreComparedWithStatesBeforeAveraging) {
  std::string text = "time [s],x [m],v [m/s]\n";
  for (int i = 0; i <= 96; ++i) text += fmt::format("{},{},0.5\n", 0.0125 * i, i % 2 == 0 ? 0.01 : -0.01);
  const std::filesystem::path path = fake::test_folder() / "log.csv";
  files::write_file(path, text);
  const auto log_with = [&](const char* average) {
    const StudySetup setup = set_up({.robot = "line", .prior = {}, .settings = {{"read.average", average}}});
    Violations violations;
    return read_logs({path.string()}, {}, setup, violations).logs.at(0).log;
  };
  const study::Log averaged = log_with("true"), plain = log_with("false");
  EXPECT_EQ(plain.measured, plain.episode.states);
  EXPECT_EQ(averaged.measured, plain.episode.states);
  EXPECT_LT(averaged.episode.states.cwiseAbs().maxCoeff(), 0.009);
}

}  // namespace
}  // namespace rehearse::experiment
