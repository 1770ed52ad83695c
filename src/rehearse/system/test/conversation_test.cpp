#include "rehearse/system/conversation.hpp"

#include <gtest/gtest.h>

#include "rehearse/system/test/programs.hpp"

namespace rehearse::system {
namespace {

TEST(Conversation, SaysWhatTheProgramUnderstands) {
  EXPECT_FALSE(Conversation(hostile_program("doubles")).has_episodes());
  Conversation robot(robot_program());
  EXPECT_TRUE(robot.has_episodes());
  Matrix dX(1, 3);
  EXPECT_FALSE(robot.change(Matrix::Zero(1, 3), Matrix::Zero(1, 1), Vector{{1}}, dX));
  EXPECT_NE(robot.problem().find("does not understand"), std::string::npos);
}

TEST(Conversation, GoesOnAfterAnError) {
  Conversation robot(hostile_program("json"));
  Matrix dX(1, 3);
  EXPECT_FALSE(
      robot.change(Matrix::Zero(1, 3), Matrix::Constant(1, 1, static_cast<double>(Harm::error)), Vector{{1}}, dX));
  EXPECT_TRUE(robot.declined());
  EXPECT_NE(robot.problem().find("out of reach"), std::string::npos);
  EXPECT_TRUE(robot.change(Matrix::Zero(1, 3), Matrix::Zero(1, 1), Vector{{1}}, dX));
  EXPECT_EQ(dX, Matrix::Ones(1, 3));
  EXPECT_FALSE(robot.declined());
}

TEST(Conversation, OneThatIsLateIsQuoted) {
  Program program = test_program({"sh", "-c", "read line; echo '[1]'; sleep 100"});
  program.start_s = 0.5;
  EXPECT_EQ(Conversation(program).problem(),
            "the program 'sh -c read line; echo '[1]'; sleep 100': it did not answer within 0.5 s; it wrote: [1]");
  program.command = {"sleep", "100"};
  EXPECT_EQ(Conversation(program).problem(), "the program 'sleep 100': it did not answer within 0.5 s");
}

TEST(Conversation, AProblemNamesTheProgramAndItsLastWords) {
  const Conversation conversation(test_program({"sh", "-c", "echo words >&2"}));
  EXPECT_EQ(conversation.problem(),
            "the program 'sh -c echo words >&2': it ended with exit status 0; its standard error ends with\nwords");
}

}  // namespace
}  // namespace rehearse::system
