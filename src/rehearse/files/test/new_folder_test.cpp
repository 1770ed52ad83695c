#include "rehearse/files/new_folder.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::files {
namespace {

namespace fs = std::filesystem;

TEST(NewFolder, AppearsWithAllThatIsInIt) {
  const fs::path outer = test_folder(), path = outer / "outer" / "run";
  {
    NewFolder folder(path / "");
    EXPECT_EQ(name_of_hidden(folder.hidden().filename().string()), "run");
    std::ofstream(folder.hidden() / "file") << "text";
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(folder.appear());
  }
  EXPECT_TRUE(fs::exists(path / "file"));
  EXPECT_EQ(std::distance(fs::directory_iterator(outer / "outer"), fs::directory_iterator()), 1);
}

TEST(NewFolder, LeavesNothingUnlessItAppears) {
  const fs::path outer = test_folder();
  {
    const NewFolder folder(outer / "a" / "b" / "run");
    std::ofstream(folder.hidden() / "file") << "text";
  }
  EXPECT_TRUE(fs::is_empty(outer));
  {
    const NewFolder folder(outer / "a" / "b" / "run");
    std::ofstream(outer / "a" / "other") << "somebody else's";
  }
  EXPECT_TRUE(fs::exists(outer / "a" / "other"));
  EXPECT_FALSE(fs::exists(outer / "a" / "b"));
}

TEST(NewFolder, TakesNoOthersPlace) {
  const fs::path outer = test_folder();
  {
    NewFolder folder(outer / "run");
    fs::create_directory(outer / "run");
    EXPECT_FALSE(folder.appear());
  }
  EXPECT_TRUE(fs::is_empty(outer / "run"));
  std::ofstream(outer / "file") << "no folder";
  const auto message = message_of<InvalidInput>([&] { const NewFolder folder(outer / "file" / "run"); });
  EXPECT_NE(message.find("cannot create"), std::string::npos) << message;
}

TEST(NewFolder, HasAHiddenName) {
  EXPECT_EQ(name_of_hidden(".run.12"), "run");
  EXPECT_EQ(name_of_hidden(".a.b-1.12"), "a.b-1");
  for (const char* other : {"run.12", ".run", ".run.", ".run.x", ".run.1x", "..12", ".12", ""})
    EXPECT_FALSE(name_of_hidden(other)) << other;
}

}  // namespace
}  // namespace rehearse::files
