#include "rehearse/experiment/kept_robot.hpp"

#include <gtest/gtest.h>

#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/temporary_folder.hpp"

namespace rehearse::experiment {
namespace {

TEST(KeptRobot, IsThereWithItsFiles) {
  const files::TemporaryFolder folder;
  keep_robot({"mine", "mine.toml", "text", {{"a.py", "one"}, {"data/b.csv", "two"}}}, folder.path());
  EXPECT_EQ(files::read_file(folder.path() / "robot.toml"), "text");
  EXPECT_EQ(files::read_file(folder.path() / "robot/a.py"), "one");
  EXPECT_EQ(files::read_file(folder.path() / "robot/data/b.csv"), "two");
}

TEST(KeptRobot, ARunOfABuiltInRobotHasNone) {
  const files::TemporaryFolder folder;
  EXPECT_TRUE(with_robot_of_run({}, folder.path()).robots.empty());
  EXPECT_TRUE(with_robot_of_run({}, folder.path()).of_run);
}

}  // namespace
}  // namespace rehearse::experiment
