#include "rehearse/experiment/kept_robot.hpp"

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

TEST(KeptRobot, IsThereWithItsFiles) {
  const files::TemporaryFolder folder;
  keep_robot({"mine", "mine.toml", "text", {{"a.py", "one"}, {"data/b.csv", "two"}}}, folder.path());
  EXPECT_EQ(files::read_file(folder.path() / "robot.toml"), "text");
  EXPECT_EQ(files::read_file(folder.path() / "robot/a.py"), "one");
  EXPECT_EQ(files::read_file(folder.path() / "robot/data/b.csv"), "two");
}

TEST(KeptRobot, ItsFileIsARobotElsewhereToo) {
  const files::TemporaryFolder folder;
  std::optional<std::string> program;
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios.clear();
  catalogue.read_robot = [&program](std::string_view, const std::string&, const scenario::ReadFile& read_file) {
    program = read_file("a.py");
    return [] { return std::make_unique<fake::LineBuilder>(); };
  };
  files::write_file(folder.path() / "a.py", "beside");
  keep_robot({"line", "line.toml", "text", {{"a.py", "kept"}}}, folder.path());
  const auto program_of = [&](const std::string& file) {
    EXPECT_EQ(with_robot_of_file(catalogue, folder.path() / file, "it").robots.front().source, "it");
    return program;
  };
  EXPECT_EQ(program_of("robot.toml"), "beside") << "of a user, who may call a folder robot";
  files::write_file(folder.path() / "spec.toml", "");
  EXPECT_EQ(program_of("robot.toml"), "kept");
  files::write_file(folder.path() / "mine.toml", "other text");
  EXPECT_EQ(program_of("mine.toml"), "beside");
}

TEST(KeptRobot, ARunOfABuiltInRobotHasNone) {
  const files::TemporaryFolder folder;
  EXPECT_TRUE(with_robot_of_run({}, folder.path()).robots.empty());
  EXPECT_TRUE(with_robot_of_run({}, folder.path()).of_run);
}

}  // namespace
}  // namespace rehearse::experiment
