#include "rehearse/experiment/study_setup.hpp"

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/core/errors.hpp"

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
}

}  // namespace
}  // namespace rehearse::experiment
